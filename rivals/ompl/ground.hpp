// The occupied cells of a map, and whether a convex body stands free of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

/// A point of the plane.
struct Point {
    double x, y;
};

/// x, y and heading.
struct Pose {
    double x, y, heading;
};

/// A convex polygon, counter-clockwise.
using Polygon = std::vector<Point>;

/// Moves every edge outward; corners stay sharp, so that the result covers the grown body.
inline Polygon grown(const Polygon &body, double by) {
    const std::size_t n = body.size();
    Polygon out;
    for (std::size_t i = 0; i < n; ++i) {
        const Point &before = body[(i + n - 1) % n], &at = body[i], &after = body[(i + 1) % n];
        const auto normal = [](const Point &a, const Point &b) {
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            return Point{(b.y - a.y) / length, (a.x - b.x) / length};
        };
        const Point u = normal(before, at), v = normal(at, after);
        const double share = by / (1 + u.x * v.x + u.y * v.y);
        out.push_back({at.x + share * (u.x + v.x), at.y + share * (u.y + v.y)});
    }
    return out;
}

/// A disc about a point of the body: none of it leaves the body within `inner`, and all discs
/// together cover the body within `outer`. In cells.
struct Disc {
    Point center;
    double inner, outer;
};

/// Discs in a row along a body.
inline std::vector<Disc> discs_of(const Polygon &body) {
    const auto by_x = [](const Point &a, const Point &b) { return a.x < b.x; };
    const auto by_y = [](const Point &a, const Point &b) { return a.y < b.y; };
    const auto [left, right] = std::minmax_element(body.begin(), body.end(), by_x);
    const auto [low, high] = std::minmax_element(body.begin(), body.end(), by_y);
    const double length = right->x - left->x, width = high->y - low->y;
    const int n_discs = std::clamp(static_cast<int>(std::ceil(length / width)), 1, 16);
    std::vector<Disc> discs;
    for (int i = 0; i < n_discs; ++i) {
        const Point center{left->x + (i + 0.5) * length / n_discs, 0.5 * (low->y + high->y)};
        double inner = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < body.size(); ++k) {
            const Point &a = body[k], &b = body[(k + 1) % body.size()];
            const double cross = (b.x - a.x) * (center.y - a.y) - (b.y - a.y) * (center.x - a.x);
            inner = std::min(inner, cross / std::hypot(b.x - a.x, b.y - a.y));
        }
        discs.push_back({center, inner, std::hypot(0.5 * length / n_discs, 0.5 * width)});
    }
    return discs;
}

/// Squared distances along a line to the nearest of parabolas that stand on it at their values.
class Envelope {
public:
    explicit Envelope(std::size_t n) : values_(n), apexes_(n), begins_(n + 1) {}

    std::vector<double> &values() { return values_; }

    /// Replaces the values by the lower envelope of the parabolas over them.
    void lower(std::size_t n) {
        constexpr double INFINITE = std::numeric_limits<double>::infinity();
        std::size_t n_parts = 0;
        for (std::size_t q = 0; q < n; ++q) {
            if (values_[q] == INFINITE) {
                continue;
            }
            double begin = -INFINITE;
            while (n_parts > 0) {
                begin = crossing(apexes_[n_parts - 1], q);
                if (begin > begins_[n_parts - 1]) {
                    break;
                }
                --n_parts;
                begin = -INFINITE;
            }
            apexes_[n_parts] = q;
            begins_[n_parts++] = begin;
        }
        if (n_parts > 0) {
            fill(n, n_parts);
        }
    }

private:
    /// The place from which on the parabola at `q` is below that at `p` < `q`.
    double crossing(std::size_t p, std::size_t q) const {
        const double at_p = static_cast<double>(p), at_q = static_cast<double>(q);
        return 0.5 * ((values_[q] - values_[p]) / (at_q - at_p) + at_p + at_q);
    }

    void fill(std::size_t n, std::size_t n_parts) {
        std::vector<double> &out = scratch_;
        out.resize(n);
        std::size_t part = 0;
        for (std::size_t q = 0; q < n; ++q) {
            const double at = static_cast<double>(q);
            while (part + 1 < n_parts && begins_[part + 1] < at) {
                ++part;
            }
            const double away = at - static_cast<double>(apexes_[part]);
            out[q] = away * away + values_[apexes_[part]];
        }
        std::copy(out.begin(), out.end(), values_.begin());
    }

    std::vector<double> values_, scratch_;
    std::vector<std::size_t> apexes_;
    std::vector<double> begins_;
};

/// Occupied cells in a border of occupied ones; beyond the border everything is occupied.
class Ground {
public:
    /// Reads map and vehicle of a question. The body is grown by `slack_m`.
    Ground(const nlohmann::json &map, const nlohmann::json &vehicle, double slack_m)
        : resolution_m_(map.at("resolution_m")), n_cols_(map.at("n_cols").get<int>() + 2),
          n_rows_(map.at("n_rows").get<int>() + 2) {
        const auto &origin = map.at("origin");
        origin_ = {origin.at(0), origin.at(1), origin.at(2)};
        cos_origin_ = std::cos(origin_.heading);
        sin_origin_ = std::sin(origin_.heading);
        Polygon body;
        for (const auto &corner : vehicle.at("footprint")) {
            body.push_back({corner.at(0).get<double>() / resolution_m_,
                            corner.at(1).get<double>() / resolution_m_});
        }
        body_ = grown(body, slack_m / resolution_m_);
        discs_ = discs_of(body_);
        digits_ = map.at("lethal").get<std::string>();
        if (digits_.size() != 2 * ((n_cols_ - 2 + 7) / 8) * static_cast<std::size_t>(n_rows_ - 2)) {
            throw std::runtime_error("map.lethal: not as many digits as the map needs");
        }
    }

    /// Unpacks the cells and measures distances to them: the preparation that is timed.
    void prepare() {
        unpack();
        count_occupied();
        measure_distances();
    }

    double resolution_m() const { return resolution_m_; }

    /// Corners of the map.
    std::vector<Point> corners_m() const {
        std::vector<Point> corners;
        for (const double u : {0, n_cols_ - 2}) {
            for (const double v : {0, n_rows_ - 2}) {
                const double x = u * resolution_m_, y = v * resolution_m_;
                corners.push_back({origin_.x + cos_origin_ * x - sin_origin_ * y,
                                   origin_.y + sin_origin_ * x + cos_origin_ * y});
            }
        }
        return corners;
    }

    /// True if the grown body touches no occupied square.
    bool is_free(const Pose &pose) const {
        const double dx = (pose.x - origin_.x) / resolution_m_;
        const double dy = (pose.y - origin_.y) / resolution_m_;
        const Point at{cos_origin_ * dx + sin_origin_ * dy + 1, cos_origin_ * dy - sin_origin_ * dx + 1};
        const double cos = std::cos(pose.heading - origin_.heading);
        const double sin = std::sin(pose.heading - origin_.heading);
        bool is_far = true;
        for (const Disc &disc : discs_) {
            const double away = distance_at({at.x + cos * disc.center.x - sin * disc.center.y,
                                             at.y + sin * disc.center.x + cos * disc.center.y});
            if (away + HALF_DIAGONAL <= disc.inner) {
                return false;
            }
            is_far = is_far && away - 2 * HALF_DIAGONAL > disc.outer;
        }
        return is_far || is_apart(at, cos, sin);
    }

private:
    /// From the center of a cell to its corner, in cells.
    static constexpr double HALF_DIAGONAL = 0.70710678118654752;
    static constexpr std::size_t MAX_CORNERS = 64;

    void unpack() {
        occupied_.assign(static_cast<std::size_t>(n_cols_) * n_rows_, 1);
        const int n_digits = 2 * ((n_cols_ - 2 + 7) / 8);
        for (int row = 0; row < n_rows_ - 2; ++row) {
            const char *digits = &digits_[static_cast<std::size_t>(row) * n_digits];
            std::uint8_t *cells = &occupied_[index(1, row + 1)];
            for (int col = 0; col < n_cols_ - 2; ++col) {
                const char digit = digits[col / 4];
                const int bits = digit <= '9' ? digit - '0' : (digit | 32) - 'a' + 10;
                cells[col] = bits >> (3 - col % 4) & 1;
            }
        }
    }

    /// Occupied cells of each row before each column.
    void count_occupied() {
        n_before_.assign(static_cast<std::size_t>(n_cols_ + 1) * n_rows_, 0);
        for (int row = 0; row < n_rows_; ++row) {
            std::int32_t *n_before = &n_before_[static_cast<std::size_t>(row) * (n_cols_ + 1)];
            for (int col = 0; col < n_cols_; ++col) {
                n_before[col + 1] = n_before[col] + occupied_[index(col, row)];
            }
        }
    }

    /// Distances between cell centers to the nearest occupied cell, after Felzenszwalb and
    /// Huttenlocher 2012: columns first, then rows.
    void measure_distances() {
        distances_.resize(occupied_.size());
        Envelope line(std::max(n_cols_, n_rows_));
        for (int col = 0; col < n_cols_; ++col) {
            for (int row = 0; row < n_rows_; ++row) {
                const bool is_occupied = occupied_[index(col, row)] != 0;
                line.values()[row] = is_occupied ? 0 : std::numeric_limits<double>::infinity();
            }
            line.lower(n_rows_);
            for (int row = 0; row < n_rows_; ++row) {
                distances_[index(col, row)] = static_cast<float>(line.values()[row]);
            }
        }
        for (int row = 0; row < n_rows_; ++row) {
            float *distances = &distances_[index(0, row)];
            std::copy(distances, distances + n_cols_, line.values().begin());
            line.lower(n_cols_);
            for (int col = 0; col < n_cols_; ++col) {
                distances[col] = static_cast<float>(std::sqrt(line.values()[col]));
            }
        }
    }

    /// From the center of the cell at a point to that of the nearest occupied one; off the map less
    /// than any distance.
    double distance_at(const Point &point) const {
        const double col = std::floor(point.x), row = std::floor(point.y);
        if (col < 0 || row < 0 || col >= n_cols_ || row >= n_rows_) {
            return -1e9;
        }
        return distances_[index(static_cast<int>(col), static_cast<int>(row))];
    }

    /// Looks at the cells of every row between the first and the last that the body reaches.
    bool is_apart(const Point &at, double cos, double sin) const {
        Point corners[MAX_CORNERS];
        const std::size_t n = std::min(body_.size(), MAX_CORNERS);
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t i = 0; i < n; ++i) {
            const Point &corner = body_[i];
            corners[i] = {at.x + cos * corner.x - sin * corner.y,
                          at.y + sin * corner.x + cos * corner.y};
            low = std::min(low, corners[i].y);
            high = std::max(high, corners[i].y);
        }
        if (low < 0 || high >= n_rows_) {
            return false;
        }
        for (int row = static_cast<int>(low); row <= static_cast<int>(high); ++row) {
            double left = std::numeric_limits<double>::infinity(), right = -left;
            for (std::size_t i = 0; i < n; ++i) {
                widen(corners[i], corners[i + 1 == n ? 0 : i + 1], row, left, right);
            }
            if (left > right) {
                continue;
            }
            if (left < 0 || right >= n_cols_) {
                return false;
            }
            const std::int32_t *n_before = &n_before_[static_cast<std::size_t>(row) * (n_cols_ + 1)];
            if (n_before[static_cast<int>(right) + 1] != n_before[static_cast<int>(left)]) {
                return false;
            }
        }
        return true;
    }

    /// Widens an interval of x by the part of an edge within a row.
    static void widen(const Point &a, const Point &b, double row, double &left, double &right) {
        const double low = std::max(std::min(a.y, b.y), row);
        const double high = std::min(std::max(a.y, b.y), row + 1);
        if (low > high) {
            return;
        }
        const bool is_level = std::abs(b.y - a.y) < 1e-12;
        const double slope = is_level ? 0 : (b.x - a.x) / (b.y - a.y);
        const double from = is_level ? a.x : a.x + slope * (low - a.y);
        const double to = is_level ? b.x : a.x + slope * (high - a.y);
        left = std::min({left, from, to});
        right = std::max({right, from, to});
    }

    std::size_t index(int col, int row) const {
        return static_cast<std::size_t>(row) * n_cols_ + col;
    }

    double resolution_m_, cos_origin_ = 1, sin_origin_ = 0;
    int n_cols_, n_rows_;
    Pose origin_{};
    Polygon body_;
    std::vector<Disc> discs_;
    std::string digits_;
    std::vector<std::uint8_t> occupied_;
    std::vector<std::int32_t> n_before_;
    std::vector<float> distances_;
};
