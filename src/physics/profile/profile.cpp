#include "physics/profile/profile.hpp"

#include <glm/common.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lutka::physics {
namespace {

// Collects problems, each with its place.
class Problems {
  public:
    void require(bool holds, const std::string& place, std::string_view expected) {
        if (!holds) lines_.push_back(place + ": " + std::string(expected));
    }
    [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

  private:
    std::vector<std::string> lines_;
};

bool isPositive(float value) {
    return std::isfinite(value) && value > 0.0F;
}

bool isPositive(const vec3& v) {
    return isPositive(v.x) && isPositive(v.y) && isPositive(v.z);
}

bool isUnit(const quat& q) {
    return isFinite(q) && std::abs(glm::dot(q, q) - 1.0F) < 1e-4F;
}

void checkFrame(Problems& problems, const RigidTransform& frame, const std::string& place) {
    problems.require(isUnit(frame.rotation), place + "/rotation", "expected a finite quaternion of length 1");
    problems.require(isFinite(frame.translation), place + "/translation", "expected three finite numbers");
}

void checkShape(Problems& problems, const BodyShape& shape, const std::string& place) {
    if (shape.kind == BodyShape::Kind::box) {
        problems.require(isPositive(shape.halfExtents), place + "/halfExtents", "expected three numbers above 0");
        return;
    }
    problems.require(isPositive(shape.radius), place + "/radius", "expected a number above 0");
    if (shape.kind == BodyShape::Kind::capsule) {
        problems.require(std::isfinite(shape.halfLength) && shape.halfLength >= 0.0F, place + "/halfLength",
                         "expected a number of at least 0");
    }
}

void checkBody(Problems& problems, const RagdollProfile& profile, std::size_t index) {
    const BodyProfile& body = profile.bodies[index];
    const std::string place = fmt::format("/bodies/{}", index);
    checkShape(problems, body.shape, place + "/shape");
    checkFrame(problems, body.jointFromBody, place + "/jointFromBody");
    problems.require(isPositive(body.massKg), place + "/massKg", "expected a number above 0");
    problems.require(isPositive(body.inertia), place + "/inertia", "expected three numbers above 0");
    problems.require(!body.jointPath.empty(), place + "/jointPath", "expected the path of a joint");
    for (std::size_t other = 0; other < index; ++other) {
        problems.require(profile.bodies[other].role != body.role, place + "/role",
                         fmt::format("expected a role of its own, body {} has it already", other));
        problems.require(profile.bodies[other].jointPath != body.jointPath, place + "/jointPath",
                         fmt::format("expected a joint of its own, body {} is on it already", other));
    }
}

bool isAngle(float angle, float low, float high) {
    // Radians as floats may round past pi.
    constexpr float kSlack = 1e-5F;
    return std::isfinite(angle) && angle >= low - kSlack && angle <= high + kSlack;
}

void checkLimits(Problems& problems, const ConstraintProfile& constraint, const std::string& place) {
    if (constraint.kind == ConstraintProfile::Kind::hinge) {
        const HingeLimits& hinge = constraint.hinge;
        problems.require(isAngle(hinge.lower, -kPi, 0), place + "/hinge/lower", "expected radians in [-pi, 0]");
        problems.require(isAngle(hinge.upper, 0, kPi), place + "/hinge/upper", "expected radians in [0, pi]");
        return;
    }
    const auto check = [&](float angle, const char* name) {
        problems.require(isPositive(angle) && angle < kPi, place + "/cone/" + name, "expected radians in (0, pi)");
    };
    check(constraint.cone.swingY, "swingY");
    check(constraint.cone.swingZ, "swingZ");
    check(constraint.cone.twist, "twist");
}

void checkConstraint(Problems& problems, const RagdollProfile& profile, std::size_t index) {
    const ConstraintProfile& constraint = profile.constraints[index];
    const std::string place = fmt::format("/constraints/{}", index);
    const int bodies = static_cast<int>(profile.bodies.size());
    problems.require(constraint.child == static_cast<int>(index) + 1 && constraint.child < bodies, place + "/child",
                     fmt::format("expected body {}, the constraints follow their children's order", index + 1));
    problems.require(constraint.parent >= 0 && constraint.parent < bodies, place + "/parent", "expected a body");
    problems.require(constraint.parent < constraint.child, place + "/parent",
                     "expected a body before the child (parents come first, so that there is no cycle)");
    checkFrame(problems, constraint.parentFromFrame, place + "/parentFromFrame");
    checkFrame(problems, constraint.childFromFrame, place + "/childFromFrame");
    checkLimits(problems, constraint, place);
    problems.require(std::isfinite(constraint.frictionNm) && constraint.frictionNm >= 0.0F, place + "/frictionNm",
                     "expected a number of at least 0");
}

void checkWhole(Problems& problems, const RagdollProfile& profile) {
    problems.require(isPositive(profile.heightM), "/heightM", "expected a number above 0");
    problems.require(isPositive(profile.totalMassKg), "/totalMassKg", "expected a number above 0");
    problems.require(isUnit(profile.standardFromModel), "/standardFromModel",
                     "expected a finite quaternion of length 1");
    problems.require(!profile.bodies.empty(), "/bodies", "expected at least one body");
    problems.require(profile.bodies.empty() || profile.bodies[0].role == Role::hips, "/bodies/0/role",
                     "expected hips, the root of the bodies");
    problems.require(profile.constraints.size() + 1 == std::max<std::size_t>(profile.bodies.size(), 1), "/constraints",
                     "expected one for every body but the first");
    double sum = 0.0;
    for (const BodyProfile& body : profile.bodies)
        sum += body.massKg;
    problems.require(profile.bodies.empty() || std::abs(sum - profile.totalMassKg) <= 1e-5 * profile.totalMassKg,
                     "/totalMassKg", fmt::format("expected the sum of the bodies' masses, {:.6g}", sum));
}

}  // namespace

vec3 conditionedInertia(const RagdollProfile& profile, const BodyProfile& body, float leastGyration) {
    constexpr float kReferenceHeight = 1.75F;
    const float gyration = leastGyration * profile.heightM / kReferenceHeight;
    return glm::max(body.inertia, vec3(body.massKg * gyration * gyration));
}

int bodyOf(const RagdollProfile& profile, Role role) {
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        if (profile.bodies[body].role == role) return static_cast<int>(body);
    }
    return -1;
}

std::vector<std::string> validate(const RagdollProfile& profile) {
    Problems problems;
    checkWhole(problems, profile);
    for (std::size_t body = 0; body < profile.bodies.size(); ++body)
        checkBody(problems, profile, body);
    for (std::size_t constraint = 0; constraint < profile.constraints.size(); ++constraint)
        checkConstraint(problems, profile, constraint);
    const int bodies = static_cast<int>(profile.bodies.size());
    for (std::size_t i = 0; i < profile.filteredPairs.size(); ++i) {
        const auto& [first, second] = profile.filteredPairs[i];
        problems.require(first >= 0 && first < second && second < bodies, fmt::format("/filteredPairs/{}", i),
                         "expected two bodies, the earlier one first");
    }
    return problems.take();
}

}  // namespace lutka::physics
