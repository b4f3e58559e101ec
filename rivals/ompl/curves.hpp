// Curves of arcs, and the shortest of them for a car that drives forward only.
#pragma once

#include "ground.hpp"

#include <array>

constexpr double PI = 3.14159265358979323846;

/// A part of one curvature; a negative length is driven in reverse.
struct Arc {
    double curvature, length;
};

/// The pose after a signed length along a curvature.
inline Pose driven(const Pose &from, double curvature, double length) {
    const double heading = from.heading + curvature * length;
    if (curvature == 0) {
        return {from.x + length * std::cos(heading), from.y + length * std::sin(heading), heading};
    }
    return {from.x + (std::sin(heading) - std::sin(from.heading)) / curvature,
            from.y - (std::cos(heading) - std::cos(from.heading)) / curvature, heading};
}

/// Up to five arcs in a row from a pose on.
class Curve {
public:
    explicit Curve(const Pose &start) : last_(start) {}

    /// Appends an arc; one that is too short to be seen is left out.
    void add(double curvature, double length) {
        if (std::abs(length) < 1e-12) {
            return;
        }
        begins_[n_arcs_] = last_;
        arcs_[n_arcs_++] = {curvature, length};
        last_ = driven(last_, curvature, length);
        length_ += std::abs(length);
    }

    double length() const { return length_; }
    int n_arcs() const { return n_arcs_; }
    const Arc &arc(int i) const { return arcs_[i]; }
    const Pose &begin_of(int i) const { return begins_[i]; }

    /// The pose at a distance from the start.
    Pose at(double distance) const {
        for (int i = 0; i < n_arcs_; ++i) {
            const double length = std::abs(arcs_[i].length);
            if (distance <= length) {
                return driven(begins_[i], arcs_[i].curvature, std::copysign(distance, arcs_[i].length));
            }
            distance -= length;
        }
        return last_;
    }

private:
    std::array<Arc, 5> arcs_{};
    std::array<Pose, 5> begins_{};
    int n_arcs_ = 0;
    double length_ = 0;
    Pose last_;
};

/// An angle from 0 up to a full turn; what rounding has left just below a full turn is none.
inline double turn(double angle) {
    const double turned = angle - 2 * PI * std::floor(angle / (2 * PI));
    return turned > 2 * PI - 1e-9 ? 0 : turned;
}

/// The three arcs of a Dubins word: turn, middle, turn. Turns are signed by their side.
struct DubinsWord {
    double first_side, first, middle_side, middle, last_side, last;

    double length() const { return first + middle + last; }
};

/// Finds the shortest word between two poses, lengths in turning radii (Dubins 1957). Every word is
/// built from the circles beside the poses and a tangent of two of them.
class DubinsSearch {
public:
    DubinsSearch(const Pose &from, const Pose &to, double radius) : from_(from), to_(to), radius_(radius) {
        best_.middle = std::numeric_limits<double>::infinity();
        for (const double first : {1.0, -1.0}) {
            for (const double last : {1.0, -1.0}) {
                between(first, last);
            }
        }
    }

    const DubinsWord &best() const { return best_; }

private:
    /// The center of the circle on a side of a pose, in radii.
    Point center(const Pose &pose, double side) const {
        return {pose.x / radius_ - side * std::sin(pose.heading), pose.y / radius_ + side * std::cos(pose.heading)};
    }

    void between(double first, double last) {
        const Point a = center(from_, first), b = center(to_, last);
        const double away = std::hypot(b.x - a.x, b.y - a.y);
        const double bearing = std::atan2(b.y - a.y, b.x - a.x);
        if (first == last) {
            straight(first, last, bearing, away);
            if (away <= 4) {
                const double bend = std::acos(away / 4);
                curved(first, bearing + bend, a, b);
                curved(first, bearing - bend, a, b);
            }
        } else if (away >= 2) {
            const double tangent = bearing + first * std::asin(2 / away);
            straight(first, last, tangent, std::sqrt(std::max(0.0, away * away - 4)));
        }
    }

    void straight(double first, double last, double heading, double length) {
        keep({first, turn(first * (heading - from_.heading)), 0, length, last,
              turn(last * (to_.heading - heading))});
    }

    /// Turn, turn against it, turn: the middle circle stands at an angle from the first.
    void curved(double side, double angle, const Point &a, const Point &b) {
        const Point middle{a.x + 2 * std::cos(angle), a.y + 2 * std::sin(angle)};
        const double enters = angle + side * PI / 2;
        const double leaves = std::atan2(middle.y - b.y, middle.x - b.x) + side * PI / 2;
        keep({side, turn(side * (enters - from_.heading)), -side, turn(-side * (leaves - enters)), side,
              turn(side * (to_.heading - leaves))});
    }

    void keep(const DubinsWord &word) {
        if (word.length() < best_.length()) {
            best_ = word;
        }
    }

    Pose from_, to_;
    double radius_;
    DubinsWord best_{};
};

/// The shortest curve between two poses without reverse.
inline Curve dubins(const Pose &from, const Pose &to, double radius) {
    const DubinsWord word = DubinsSearch(from, to, radius).best();
    Curve curve(from);
    curve.add(word.first_side / radius, word.first * radius);
    curve.add(word.middle_side / radius, word.middle * radius);
    curve.add(word.last_side / radius, word.last * radius);
    return curve;
}
