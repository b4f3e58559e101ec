//! A ROS map: its description as YAML up to the first zero byte, then the image.
#![no_main]

use formicar::map::format::{GreyImage, RosMapDescription};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut parts = bytes.splitn(2, |&byte| byte == 0);
    let yaml = parts.next().and_then(formicar_fuzz::text);
    let description = yaml.and_then(|yaml| RosMapDescription::from_yaml(yaml).ok());
    let image = parts.next().and_then(|bytes| GreyImage::from_bytes(bytes).ok());
    if let (Some(description), Some(image)) = (description, image) {
        let _ = description.to_grid(&image);
    }
});
