// State spaces of car-like vehicles, and the validity of their motions.
#pragma once

#include "curves.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateValidityChecker.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>

#include <memory>

namespace ob = ompl::base;

inline Pose pose_of(const ob::State *state) {
    const auto *se2 = state->as<ob::SE2StateSpace::StateType>();
    return {se2->getX(), se2->getY(), se2->getYaw()};
}

inline void set_pose(ob::State *state, const Pose &pose) {
    auto *se2 = state->as<ob::SE2StateSpace::StateType>();
    se2->setXY(pose.x, pose.y);
    // OMPL's headings are below pi.
    const double heading = std::remainder(pose.heading, 2 * PI);
    se2->setYaw(heading < PI ? heading : -PI);
}

/// The curve that a space drives between two states.
class CurveSpace {
public:
    virtual ~CurveSpace() = default;
    virtual Curve curve(const ob::State *from, const ob::State *to) const = 0;
};

/// Forward only. OMPL's own Dubins space aborts where rounding makes a length negative, as Debian
/// compiles its assertions in.
class DubinsSpace : public ob::SE2StateSpace, public CurveSpace {
public:
    explicit DubinsSpace(double radius_m) : radius_m_(radius_m) {}

    Curve curve(const ob::State *from, const ob::State *to) const override {
        return dubins(pose_of(from), pose_of(to), radius_m_);
    }

    double distance(const ob::State *from, const ob::State *to) const override {
        return radius_m_ * DubinsSearch(pose_of(from), pose_of(to), radius_m_).best().length();
    }

    void interpolate(const ob::State *from, const ob::State *to, double t, ob::State *state) const override {
        const Curve whole = curve(from, to);
        set_pose(state, whole.at(t * whole.length()));
    }

    bool isMetricSpace() const override { return false; }
    bool hasSymmetricDistance() const override { return false; }
    bool hasSymmetricInterpolate() const override { return false; }

    void sanityChecks() const override {
        const int skipped = STATESPACE_INTERPOLATION | STATESPACE_TRIANGLE_INEQUALITY |
                            STATESPACE_DISTANCE_BOUND | STATESPACE_DISTANCE_SYMMETRIC;
        ob::StateSpace::sanityChecks(1e-9, 1e-6, ~skipped);
    }

private:
    double radius_m_;
};

/// Both gears: OMPL's own space.
class ReedsSheppSpace : public ob::ReedsSheppStateSpace, public CurveSpace {
public:
    explicit ReedsSheppSpace(double radius_m) : ob::ReedsSheppStateSpace(radius_m) {}

    Curve curve(const ob::State *from, const ob::State *to) const override {
        const ReedsSheppPath path = reedsShepp(from, to);
        Curve curve(pose_of(from));
        for (int i = 0; i < 5 && path.type_[i] != RS_NOP; ++i) {
            const double side = path.type_[i] == RS_LEFT ? 1 : path.type_[i] == RS_RIGHT ? -1 : 0;
            curve.add(side / rho_, path.length_[i] * rho_);
        }
        return curve;
    }
};

/// A state is valid where the body stands free within the bounds.
class BodyChecker : public ob::StateValidityChecker {
public:
    BodyChecker(const ob::SpaceInformationPtr &space, const Ground &ground)
        : ob::StateValidityChecker(space), ground_(ground) {}

    bool isValid(const ob::State *state) const override { return ground_.is_free(pose_of(state)); }

private:
    const Ground &ground_;
};

/// A motion is valid where the body stands free every half cell of its way.
class CurveValidator : public ob::MotionValidator {
public:
    CurveValidator(const ob::SpaceInformationPtr &information, const CurveSpace &space, const Ground &ground)
        : ob::MotionValidator(information), space_(space), ground_(ground), step_m_(0.5 * ground.resolution_m()) {}

    /// Looks at the end first, then ever closer.
    bool checkMotion(const ob::State *from, const ob::State *to) const override {
        if (!ground_.is_free(pose_of(to))) {
            return noted(false);
        }
        const Curve curve = space_.curve(from, to);
        const int n = n_steps(curve);
        int stride = 1;
        while (stride < n) {
            stride *= 2;
        }
        for (; stride > 1; stride /= 2) {
            for (int i = stride / 2; i < n; i += stride) {
                if (!ground_.is_free(curve.at(curve.length() * i / n))) {
                    return noted(false);
                }
            }
        }
        return noted(true);
    }

    /// Drives as far as it can.
    bool checkMotion(const ob::State *from, const ob::State *to, std::pair<ob::State *, double> &last) const override {
        const Curve curve = space_.curve(from, to);
        const int n = n_steps(curve);
        for (int i = 1; i <= n; ++i) {
            if (!ground_.is_free(curve.at(curve.length() * i / n))) {
                last.second = static_cast<double>(i - 1) / n;
                if (last.first != nullptr) {
                    set_pose(last.first, curve.at(curve.length() * last.second));
                }
                return noted(false);
            }
        }
        return noted(true);
    }

private:
    int n_steps(const Curve &curve) const {
        return std::max(1, static_cast<int>(std::ceil(curve.length() / step_m_)));
    }

    bool noted(bool is_valid) const {
        ++(is_valid ? valid_ : invalid_);
        return is_valid;
    }

    const CurveSpace &space_;
    const Ground &ground_;
    double step_m_;
};
