//! Resources that this process has used so far, and its tie to the process that started it.

use std::fs;

/// Processor time of all threads so far, seconds; none where the platform does not tell.
pub fn cpu_s() -> Option<f64> {
    #[cfg(unix)]
    let seconds = {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
        Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
    };
    #[cfg(not(unix))]
    let seconds = None;
    seconds
}

/// Ends this process when the one that has started it ends, killed or not; on Linux.
pub fn end_with_parent() {
    #[cfg(target_os = "linux")]
    {
        // Where it is not allowed the process ends by itself, when its run is over.
        let _ =
            rustix::process::set_parent_process_death_signal(Some(rustix::process::Signal::KILL));
    }
}

/// The largest resident memory so far, bytes; none except on Linux.
pub fn peak_rss_bytes() -> Option<u64> {
    peak(&fs::read_to_string("/proc/self/status").ok()?)
}

fn peak(status: &str) -> Option<u64> {
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_the_peak() {
        let status = "Name:\tformicar\nVmPeak:\t  9000 kB\nVmHWM:\t    5124 kB\n";
        assert_eq!(peak(status), Some(5124 * 1024));
        assert_eq!(peak("Name:\tformicar\n"), None);
        assert_eq!(peak("VmHWM:\tmuch\n"), None);
    }
}
