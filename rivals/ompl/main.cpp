// Planners of OMPL (https://ompl.kavrakilab.org) as rivals in a campaign of formicar.
//
// Reads one question of the protocol formicar/rival/1 from stdin and prints one answer. The body is
// checked exactly against the squares of occupied cells, with a distance transform to accept and to
// reject early; motions every half cell. All limits are processor time.
//
// Licensed like formicar itself: MIT or Apache-2.0.

#include "spaces.hpp"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/config.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <ctime>
#include <iostream>
#include <optional>
#include <sys/resource.h>

namespace og = ompl::geometric;
using nlohmann::json;

namespace {

constexpr char SCHEMA[] = "formicar/rival/1";
const std::string VERSION = "ompl " + std::to_string(OMPL_MAJOR_VERSION) + "." +
                            std::to_string(OMPL_MINOR_VERSION) + "." + std::to_string(OMPL_PATCH_VERSION);
constexpr char USAGE[] = "usage: ompl_rival rrtconnect|restarts|bitstar|rrtstar [--time-limit S] [--slack CELLS]";
/// Distance between the poses of the answer.
constexpr double SPACING_M = 0.05;
/// A path is told where it is shorter than the one before by this share.
constexpr double LEAST_GAIN = 1e-3;
/// The wall time of a limit of processor time, on a busy machine.
constexpr double MAX_WALL = 30;

double processor_s() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Both clocks from a moment on.
struct Clock {
    double wall_begun = wall_s(), processor_begun = processor_s();

    double wall() const { return wall_s() - wall_begun; }
    double processor() const { return processor_s() - processor_begun; }
};

struct Options {
    std::string planner;
    double time_limit_s = 10;
    double slack_cells = 0.05;
};

/// A path with the moment at which it was known.
struct Known {
    double wall_s, processor_s, length_m;
    og::PathGeometric path;
};

/// A request set up for OMPL.
class Task {
public:
    Task(const json &request, const Options &options)
        : options_(options), ground_(request.at("map"), request.at("vehicle"), options.slack_cells * request.at("map").at("resolution_m").get<double>()) {
        ompl::RNG::setSeed(request.at("seed").get<std::uint64_t>() % 0xfffffffeU + 1);
        const Clock setup;
        ground_.prepare();
        make_space(request);
        setup_wall_s_ = setup.wall();
        setup_processor_s_ = setup.processor();
        limit_s_ = options.time_limit_s;
        if (request.contains("deadline_ms") && request["deadline_ms"].is_number()) {
            limit_s_ = request["deadline_ms"].get<double>() / 1e3;
        }
    }

    json answer() {
        json told{{"map_setup_s", setup_wall_s_}, {"map_setup_cpu_s", setup_processor_s_}};
        for (const auto &[name, state] : {std::pair{"start", start_->get()}, {"goal", goal_->get()}}) {
            if (!information_->satisfiesBounds(state)) {
                told["status"] = "refused";
                told["reason"] = std::string("the ") + name + " lies off the map";
                return told;
            }
            if (!information_->isValid(state)) {
                told["status"] = "refused";
                told["reason"] = std::string("the ") + name + " is nearer to an obstacle than the slack";
                return told;
            }
        }
        clock_ = Clock();
        if (options_.planner == "bitstar" || options_.planner == "rrtstar") {
            improve();
        } else {
            connect(options_.planner == "restarts");
        }
        told["query_s"] = clock_.wall();
        told["query_cpu_s"] = clock_.processor();
        tell(told);
        return told;
    }

private:
    void make_space(const json &request) {
        const double radius_m = request.at("vehicle").at("min_turning_radius_m");
        std::shared_ptr<ob::SE2StateSpace> space;
        if (request.at("motion") == "forward") {
            auto made = std::make_shared<DubinsSpace>(radius_m);
            curves_ = made.get();
            space = made;
        } else {
            auto made = std::make_shared<ReedsSheppSpace>(radius_m);
            curves_ = made.get();
            space = made;
        }
        ob::RealVectorBounds bounds(2);
        bounds.low = {1e300, 1e300};
        bounds.high = {-1e300, -1e300};
        for (const Point &corner : ground_.corners_m()) {
            bounds.low = {std::min(bounds.low[0], corner.x), std::min(bounds.low[1], corner.y)};
            bounds.high = {std::max(bounds.high[0], corner.x), std::max(bounds.high[1], corner.y)};
        }
        space->setBounds(bounds);
        information_ = std::make_shared<ob::SpaceInformation>(space);
        information_->setStateValidityChecker(std::make_shared<BodyChecker>(information_, ground_));
        information_->setMotionValidator(std::make_shared<CurveValidator>(information_, *curves_, ground_));
        information_->setup();
        start_.emplace(space);
        goal_.emplace(space);
        set_pose(start_->get(), pose(request.at("start")));
        set_pose(goal_->get(), pose(request.at("goal")));
    }

    static Pose pose(const json &list) { return {list.at(0), list.at(1), list.at(2)}; }

    ob::ProblemDefinitionPtr problem() const {
        auto problem = std::make_shared<ob::ProblemDefinition>(information_);
        problem->setStartAndGoalStates(*start_, *goal_);
        auto length = std::make_shared<ob::PathLengthOptimizationObjective>(information_);
        length->setCostThreshold(ob::Cost(0));
        problem->setOptimizationObjective(length);
        return problem;
    }

    double left_s() const { return limit_s_ - clock_.processor(); }

    /// A planner that sleeps uses no processor time, and would never end by that alone.
    bool is_over() const { return left_s() <= 0 || clock_.wall() > MAX_WALL * limit_s_; }

    ob::PlannerTerminationCondition in_time() const {
        return ob::PlannerTerminationCondition([this] { return is_over(); });
    }

    /// Notes a path that is shorter than those before.
    void note(const og::PathGeometric &path) {
        const double length_m = path.length();
        if (known_.empty() || length_m < known_.back().length_m * (1 - LEAST_GAIN)) {
            known_.push_back({clock_.wall(), clock_.processor(), length_m, path});
        }
    }

    /// RRT-Connect, simplified; again and again where it restarts.
    void connect(bool is_restarted) {
        do {
            og::RRTConnect planner(information_);
            const auto problem = this->problem();
            planner.setProblemDefinition(problem);
            planner.setup();
            planner.solve(in_time());
            if (!problem->hasExactSolution()) {
                return;
            }
            auto path = *problem->getSolutionPath()->as<og::PathGeometric>();
            note(path);
            og::PathSimplifier(information_).simplify(path, in_time());
            note(path);
        } while (is_restarted && !is_over());
    }

    /// A planner that goes on until its time is over.
    void improve() {
        std::unique_ptr<ob::Planner> planner;
        if (options_.planner == "bitstar") {
            auto bitstar = std::make_unique<og::BITstar>(information_);
            // In a space whose distances are not symmetric, pruning takes the goal away and crashes.
            bitstar->setPruning(information_->getStateSpace()->hasSymmetricDistance());
            planner = std::move(bitstar);
        } else {
            planner = std::make_unique<og::RRTstar>(information_);
        }
        const auto problem = this->problem();
        problem->setIntermediateSolutionCallback(
            [this](const auto *, const std::vector<const ob::State *> &states, const auto) { note(whole(states)); });
        planner->setProblemDefinition(problem);
        planner->setup();
        planner->solve(in_time());
    }

    /// The path of an intermediate solution: states from goal to start, of which planners leave out
    /// the ends or do not.
    og::PathGeometric whole(const std::vector<const ob::State *> &states) const {
        og::PathGeometric path(information_, start_->get());
        for (auto state = states.rbegin(); state != states.rend(); ++state) {
            if (!information_->equalStates(*state, start_->get()) && !information_->equalStates(*state, goal_->get())) {
                path.append(*state);
            }
        }
        path.append(goal_->get());
        return path;
    }

    void tell(json &told) {
        if (known_.empty()) {
            told["status"] = "not_found";
            told["reason"] = "no path within " + json(limit_s_).dump() + " s of processor time";
            return;
        }
        told["status"] = "found";
        told["first_feasible_s"] = known_.front().wall_s;
        told["first_feasible_cpu_s"] = known_.front().processor_s;
        for (const Known &known : known_) {
            told["improvements"].push_back({known.wall_s, known.length_m});
            told["improvements_cpu_s"].push_back(known.processor_s);
            if (&known != &known_.back()) {
                told["earlier_poses"].push_back(poses(known.path));
            }
        }
        told["poses"] = poses(known_.back().path);
    }

    /// The poses of a path, dense, with one at every end of an arc.
    json poses(const og::PathGeometric &path) const {
        const auto &states = const_cast<og::PathGeometric &>(path).getStates();
        json list = json::array();
        const auto append = [&](const Pose &pose) { list.push_back({pose.x, pose.y, pose.heading}); };
        append(pose_of(states.front()));
        for (std::size_t i = 1; i < states.size(); ++i) {
            const Curve curve = curves_->curve(states[i - 1], states[i]);
            for (int k = 0; k < curve.n_arcs(); ++k) {
                const Arc &arc = curve.arc(k);
                const int n = std::max(1, static_cast<int>(std::ceil(std::abs(arc.length) / SPACING_M)));
                for (int j = 1; j <= n; ++j) {
                    append(driven(curve.begin_of(k), arc.curvature, arc.length * j / n));
                }
            }
        }
        return list;
    }

    Options options_;
    Ground ground_;
    const CurveSpace *curves_ = nullptr;
    ob::SpaceInformationPtr information_;
    std::optional<ob::ScopedState<>> start_, goal_;
    double limit_s_ = 0, setup_wall_s_ = 0, setup_processor_s_ = 0;
    Clock clock_;
    std::vector<Known> known_;
};

Options options_of(int n, char **words) {
    const std::vector<std::string> known{"rrtconnect", "restarts", "bitstar", "rrtstar"};
    Options options;
    for (int i = 1; i < n; ++i) {
        const std::string word = words[i];
        if (i == 1 && std::find(known.begin(), known.end(), word) != known.end()) {
            options.planner = word;
        } else if (word == "--time-limit" && i + 1 < n) {
            options.time_limit_s = std::stod(words[++i]);
        } else if (word == "--slack" && i + 1 < n) {
            options.slack_cells = std::stod(words[++i]);
        } else {
            throw std::runtime_error(word + ": " + USAGE);
        }
    }
    if (options.planner.empty()) {
        throw std::runtime_error(USAGE);
    }
    return options;
}

json answer(const json &question, const Options &options) {
    if (question.at("schema") != SCHEMA) {
        throw std::runtime_error("schema: " + question.at("schema").dump() + "; expected " + SCHEMA);
    }
    if (question.at("ask") == "version") {
        return {{"status", "ready"}};
    }
    if (question.at("vehicle").at("motion") != "car") {
        return {{"status", "refused"}, {"reason", "it plans for cars; hint: a vehicle that steers"}};
    }
    return Task(question, options).answer();
}

std::uint64_t peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

int main(int n, char **words) {
    try {
        ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
        const Options options = options_of(n, words);
        const json question = json::parse(std::cin);
        json told = answer(question, options);
        told["version"] = VERSION;
        told["cpu_s"] = processor_s();
        told["peak_rss_bytes"] = peak_bytes();
        std::cout << told << "\n";
    } catch (const std::exception &error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
