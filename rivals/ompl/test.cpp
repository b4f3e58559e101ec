// Tests of what the rival adds to OMPL: its Dubins space against OMPL's, and its checker against
// separating axes. `build.sh test` builds and runs them.

#include "spaces.hpp"

#include <ompl/base/spaces/DubinsStateSpace.h>

#include <iostream>
#include <random>

namespace {

class Random {
public:
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
    Pose pose(double extent) { return {between(0, extent), between(0, extent), between(-PI, PI)}; }

private:
    std::mt19937 engine_{1};
};

bool told(const char *what, int n_wrong) {
    std::cout << what << ": " << n_wrong << " wrong\n";
    return n_wrong == 0;
}

/// Lengths are OMPL's, and every curve ends where it should.
bool dubins_curves_are_the_shortest() {
    constexpr double RADIUS_M = 1.3;
    const auto theirs = std::make_shared<ob::DubinsStateSpace>(RADIUS_M);
    const DubinsSpace ours(RADIUS_M);
    ob::ScopedState<> from(theirs), to(theirs);
    Random random;
    int n_wrong = 0;
    for (int i = 0; i < 100000; ++i) {
        const Pose a = random.pose(8), b = random.pose(8);
        set_pose(from.get(), a);
        set_pose(to.get(), b);
        const Curve curve = ours.curve(from.get(), to.get());
        const Pose end = curve.at(curve.length());
        const double missed = std::hypot(end.x - b.x, end.y - b.y) + std::abs(std::remainder(end.heading - b.heading, 2 * PI));
        n_wrong += std::abs(curve.length() - theirs->distance(from.get(), to.get())) > 1e-9 || missed > 1e-9;
    }
    return told("Dubins curves", n_wrong);
}

/// True if a line between two convex polygons runs along an edge of the first.
bool is_apart(const Polygon &body, const Polygon &other) {
    for (std::size_t i = 0; i < body.size(); ++i) {
        const Point &a = body[i], &b = body[(i + 1) % body.size()];
        const auto is_outside = [&](const Point &p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0; };
        if (std::all_of(other.begin(), other.end(), is_outside)) {
            return true;
        }
    }
    return false;
}

/// Bodies are free where no square of an occupied cell touches them.
bool bodies_are_checked_exactly() {
    constexpr int N_COLS = 40, N_ROWS = 32;
    const Polygon body{{-1.8, -1.4}, {4.2, -1.4}, {4.8, 0}, {4.2, 1.4}, {-1.8, 1.4}};
    Random random;
    std::string digits;
    std::vector<Polygon> squares;
    for (int row = 0; row < N_ROWS; ++row) {
        for (int col = 0; col < N_COLS; col += 4) {
            int bits = 0;
            for (int x = col; x < col + 4; ++x) {
                const bool is_occupied = random.between(0, 1) < 0.03;
                bits = 2 * bits + is_occupied;
                if (is_occupied) {
                    const double u = x, v = row;
                    squares.push_back({{u, v}, {u + 1, v}, {u + 1, v + 1}, {u, v + 1}});
                }
            }
            digits += "0123456789abcdef"[bits];
        }
    }
    nlohmann::json footprint = nlohmann::json::array();
    for (const Point &corner : body) {
        footprint.push_back({corner.x, corner.y});
    }
    const nlohmann::json map{{"n_cols", N_COLS}, {"n_rows", N_ROWS}, {"resolution_m", 1.0}, {"origin", {0, 0, 0}}, {"lethal", digits}};
    Ground ground(map, {{"footprint", footprint}}, 0);
    ground.prepare();
    int n_wrong = 0;
    for (int i = 0; i < 50000; ++i) {
        const Pose pose = random.pose(N_COLS);
        Polygon placed;
        for (const Point &corner : body) {
            placed.push_back({pose.x + std::cos(pose.heading) * corner.x - std::sin(pose.heading) * corner.y,
                              pose.y + std::sin(pose.heading) * corner.x + std::cos(pose.heading) * corner.y});
        }
        const auto is_inside = [](const Point &p) { return p.x > 0 && p.y > 0 && p.x < N_COLS && p.y < N_ROWS; };
        const auto is_free_of = [&](const Polygon &square) { return is_apart(placed, square) || is_apart(square, placed); };
        const bool is_free = std::all_of(placed.begin(), placed.end(), is_inside) && std::all_of(squares.begin(), squares.end(), is_free_of);
        n_wrong += is_free != ground.is_free(pose);
    }
    return told("Bodies", n_wrong);
}

}  // namespace

int main() {
    const bool are_curves_right = dubins_curves_are_the_shortest();
    return bodies_are_checked_exactly() && are_curves_right ? 0 : 1;
}
