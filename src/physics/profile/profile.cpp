#include "physics/profile/profile.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

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

void checkShape(Problems& problems, const PrimitiveShape& shape, const std::string& place) {
    if (shape.kind == PrimitiveShape::Kind::box) {
        problems.require(isPositive(shape.halfExtents), place + "/halfExtents", "expected three numbers above 0");
        return;
    }
    if (shape.kind == PrimitiveShape::Kind::hull) {
        const bool made = shape.hull != nullptr;
        problems.require(made, place + "/points", "expected points whose hull is not flat");
        problems.require(!made || shape.hull->points().size() <= ConvexHull::kMostPoints, place + "/points",
                         fmt::format("expected at most {} points", ConvexHull::kMostPoints));
        problems.require(!made || isCentred(*shape.hull), place + "/points",
                         "expected points about the middle of their hull's volume, which is the shape's origin");
        return;
    }
    problems.require(isPositive(shape.radius), place + "/radius", "expected a number above 0");
    if (shape.kind == PrimitiveShape::Kind::capsule) {
        problems.require(std::isfinite(shape.halfLength) && shape.halfLength >= 0.0F, place + "/halfLength",
                         "expected a number of at least 0");
    }
}

// What a body of any ragdoll can be; beyond it a float's simulation means nothing. Lengths and torques in proportion to
// the figure, so that a giant in another unit is judged like a man.
constexpr float kLeastMassKg = 1e-6F;
constexpr float kMostMassKg = 1e5F;
constexpr float kLeastHeightM = 1e-3F;
constexpr float kMostHeightM = 1e6F;
constexpr float kThinnestShare = 1e-5F;  // of the figure's height
constexpr float kWidestShare = 10.0F;
constexpr float kMostFrictionShare = 100.0F;  // of the figure's weight times its height
constexpr float kGravity = 9.81F;
constexpr float kMostPinN = 1e6F;

bool isWithin(float value, float low, float high) {
    return std::isfinite(value) && value >= low && value <= high;
}

// Half the smallest and largest extent of the shape.
std::pair<float, float> halfExtentsOf(const PrimitiveShape& shape) {
    switch (shape.kind) {
        case PrimitiveShape::Kind::box: {
            const vec3& h = shape.halfExtents;
            return {std::min({h.x, h.y, h.z}), std::max({h.x, h.y, h.z})};
        }
        case PrimitiveShape::Kind::capsule:
            return {shape.radius, shape.radius + shape.halfLength};
        case PrimitiveShape::Kind::hull:
            if (shape.hull == nullptr) return {0.0F, 0.0F};
            return {0.5F * shape.hull->thickness(), shape.hull->reach()};
        case PrimitiveShape::Kind::sphere:
            break;
    }
    return {shape.radius, shape.radius};
}

// The smallest of all shapes' and the farthest that one reaches from the body's origin.
std::pair<float, float> halfExtentsOfAll(const BodyShape& shape) {
    auto [thinnest, widest] = halfExtentsOf(shape);
    for (const AddedShape& added : shape.more) {
        const auto [thin, wide] = halfExtentsOf(added);
        thinnest = std::min(thinnest, thin);
        widest = std::max(widest, glm::length(added.bodyFromShape.translation) + wide);
    }
    return {thinnest, widest};
}

// Principal moments of any mass distribution are positive and keep the triangle inequality (Goldstein, Classical
// Mechanics, 5.4). How far the mass lies from an axis is bounded by the shape, with room for shapes that stand for more
// than themselves: the square root of moment over mass, the radius of gyration.
void checkInertia(Problems& problems, const BodyProfile& body, const std::string& place) {
    constexpr float slack = 1.01F;  // decimals
    constexpr float inward = 1.0F / 30.0F;
    constexpr float outward = 10.0F;
    const vec3& i = body.inertia;
    problems.require(isPositive(i), place, "expected three numbers above 0");
    if (!isPositive(i) || !isPositive(body.massKg)) return;
    const float most = std::max({i.x, i.y, i.z});
    problems.require(
        most <= slack * (i.x + i.y + i.z - most), place,
        fmt::format("expected no moment above the sum of the other two, got [{}, {}, {}]; no body has these", i.x, i.y,
                    i.z));
    const auto [thinnest, widest] = halfExtentsOfAll(body.shape);
    const auto momentAt = [&](float gyration) { return body.massKg * gyration * gyration; };
    const float low = momentAt(thinnest * inward);
    const float high = momentAt(widest * outward);
    problems.require(
        isWithin(std::min({i.x, i.y, i.z}), low, high) && isWithin(most, low, high), place,
        fmt::format("expected moments that fit the body's mass and shape, in [{:.3g}, {:.3g}], got [{}, {}, {}]", low,
                    high, i.x, i.y, i.z));
}

void checkSize(Problems& problems, const RagdollProfile& profile, const PrimitiveShape& shape,
               const std::string& place) {
    const auto [thinnest, widest] = halfExtentsOf(shape);
    const float low = kThinnestShare * profile.heightM;
    const float high = kWidestShare * profile.heightM;
    problems.require(isWithin(thinnest, low, high) && isWithin(widest, low, high), place,
                     fmt::format("expected radii and lengths in [{:.3g}, {:.3g}] m for a figure of {} m, got {} to {}",
                                 low, high, profile.heightM, thinnest, widest));
}

void checkAddedShapes(Problems& problems, const RagdollProfile& profile, const BodyShape& shape,
                      const std::string& place) {
    problems.require(shape.more.size() <= BodyShape::kMostAdded, place,
                     fmt::format("expected at most {} shapes beside the main one", BodyShape::kMostAdded));
    const float farthest = kWidestShare * profile.heightM;
    for (std::size_t i = 0; i < shape.more.size(); ++i) {
        const AddedShape& added = shape.more[i];
        const std::string here = fmt::format("{}/{}", place, i);
        checkShape(problems, added, here);
        checkSize(problems, profile, added, here);
        checkFrame(problems, added.bodyFromShape, here + "/bodyFromShape");
        problems.require(isWithin(glm::length(added.bodyFromShape.translation), 0.0F, farthest),
                         here + "/bodyFromShape/translation",
                         fmt::format("expected at most {:.3g} m from the body's origin", farthest));
    }
}

bool isName(std::string_view name) {
    constexpr std::size_t kLongestName = 256;
    return !name.empty() && name.size() <= kLongestName;
}

void checkBody(Problems& problems, const RagdollProfile& profile, std::size_t index) {
    const BodyProfile& body = profile.bodies[index];
    const std::string place = fmt::format("/bodies/{}", index);
    checkShape(problems, body.shape, place + "/shape");
    checkFrame(problems, body.jointFromBody, place + "/jointFromBody");
    checkSize(problems, profile, body.shape, place + "/shape");
    checkAddedShapes(problems, profile, body.shape, place + "/shape/more");
    problems.require(isWithin(body.massKg, kLeastMassKg, kMostMassKg), place + "/massKg",
                     fmt::format("expected a number in [{}, {}]", kLeastMassKg, kMostMassKg));
    checkInertia(problems, body, place + "/inertia");
    problems.require(!body.jointPath.empty(), place + "/jointPath", "expected the path of a joint");
    problems.require(isName(body.name), place + "/name", "expected a name of 1 to 256 bytes");
    for (std::size_t other = 0; other < index; ++other) {
        problems.require(profile.bodies[other].name != body.name, place + "/name",
                         fmt::format("expected a name of its own, body {} has it already", other));
        problems.require(!body.role || profile.bodies[other].role != body.role, place + "/role",
                         fmt::format("expected a role of its own, body {} has it already", other));
        problems.require(profile.bodies[other].jointPath != body.jointPath, place + "/jointPath",
                         fmt::format("expected a joint of its own, body {} is on it already", other));
    }
}

void checkFactors(Problems& problems, const MuscleFactors& factors, const std::string& place) {
    const auto check = [&](float factor, const char* name) {
        problems.require(isWithin(factor, 0.0F, MuscleFactors::kMost), place + name, "expected a number in [0, 1e6]");
    };
    check(factors.strength, "/strength");
    check(factors.damping, "/damping");
    check(factors.torque, "/torque");
}

void checkMuscles(Problems& problems, const RagdollProfile& profile) {
    for (std::size_t i = 0; i < profile.bodies.size(); ++i) {
        const BodyProfile& body = profile.bodies[i];
        const std::string place = fmt::format("/bodies/{}", i);
        checkFactors(problems, body.muscle, place + "/muscle");
        problems.require(!body.pinForceN || isWithin(*body.pinForceN, 0.0F, kMostPinN), place + "/pinForceN",
                         "expected newtons in [0, 1e6]");
    }
    if (!profile.muscles) return;
    const MuscleProfile& muscles = *profile.muscles;
    problems.require(isWithin(muscles.frequencyHz, 0.0F, MuscleProfile::kMostHz), "/muscles/frequencyHz",
                     "expected a number in [0, 1000]");
    problems.require(isWithin(muscles.dampingRatio, 0.0F, MuscleFactors::kMost), "/muscles/dampingRatio",
                     "expected a number in [0, 1e6]");
    checkFactors(problems, {muscles.strength, 1.0F, muscles.torque}, "/muscles");
    for (std::size_t group = 0; group < muscles.groups.size(); ++group)
        checkFactors(problems, muscles.groups[group], fmt::format("/muscles/groups/{}", kMuscleGroupNames[group]));
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

// `most`: of a torque for this figure, N m, and so of both a radian and a radian a second.
void checkSpring(Problems& problems, const JointSpring& spring, float most, const std::string& place) {
    const auto check = [&](float value, const char* name) {
        problems.require(isWithin(value, 0.0F, most), place + "/" + name,
                         fmt::format("expected a number in [0, {:.3g}] for this figure, got {}", most, value));
    };
    check(spring.stiffness, "stiffness");
    check(spring.damping, "damping");
    problems.require(isUnit(spring.rest), place + "/rest", "expected a finite quaternion of length 1");
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
    const float mostFriction = kMostFrictionShare * profile.totalMassKg * kGravity * profile.heightM;
    problems.require(
        isWithin(constraint.frictionNm, 0.0F, mostFriction), place + "/frictionNm",
        fmt::format("expected a number in [0, {:.3g}] for this figure, got {}", mostFriction, constraint.frictionNm));
    checkSpring(problems, constraint.spring, mostFriction, place + "/spring");
}

void checkWhole(Problems& problems, const RagdollProfile& profile) {
    problems.require(isWithin(profile.heightM, kLeastHeightM, kMostHeightM), "/heightM",
                     fmt::format("expected a number in [{}, {}]", kLeastHeightM, kMostHeightM));
    problems.require(isPositive(profile.totalMassKg), "/totalMassKg", "expected a number above 0");
    problems.require(isUnit(profile.standardFromModel), "/standardFromModel",
                     "expected a finite quaternion of length 1");
    problems.require(!profile.bodies.empty(), "/bodies", "expected at least one body");
    problems.require(profile.bodies.size() <= RagdollProfile::kMostBodies, "/bodies",
                     fmt::format("expected at most {}", RagdollProfile::kMostBodies));
    problems.require(!hasRoles(profile) || profile.bodies[0].role == Role::hips, "/bodies/0/role",
                     "expected hips, the root of the bodies that have roles");
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

int bodyNamed(const RagdollProfile& profile, std::string_view name) {
    for (std::size_t body = 0; body < profile.bodies.size(); ++body) {
        if (profile.bodies[body].name == name) return static_cast<int>(body);
    }
    return -1;
}

void setRole(BodyProfile& body, Role role) {
    body.role = role;
    body.name = roleName(role);
}

bool hasRoles(const RagdollProfile& profile) {
    return std::any_of(profile.bodies.begin(), profile.bodies.end(),
                       [](const BodyProfile& body) { return body.role.has_value(); });
}

int counterpartOf(const RagdollProfile& profile, int body) {
    const BodyProfile& own = profile.bodies[body];
    if (own.role) return sideOf(*own.role) == animation::Side::center ? -1 : bodyOf(profile, mirrored(*own.role));
    if (!own.mirror.empty()) {
        const int named = bodyNamed(profile, own.mirror);
        return named == body ? -1 : named;
    }
    for (std::size_t other = 0; other < profile.bodies.size(); ++other) {
        if (static_cast<int>(other) != body && profile.bodies[other].mirror == own.name) return static_cast<int>(other);
    }
    return -1;
}

animation::Side sideOf(const RagdollProfile& profile, int body) {
    if (const auto& role = profile.bodies[body].role) return sideOf(*role);
    const int other = counterpartOf(profile, body);
    if (other < 0) return animation::Side::center;
    return body < other ? animation::Side::left : animation::Side::right;
}

std::vector<std::string> validate(const RagdollProfile& profile) {
    Problems problems;
    checkWhole(problems, profile);
    for (std::size_t body = 0; body < profile.bodies.size(); ++body)
        checkBody(problems, profile, body);
    for (std::size_t constraint = 0; constraint < profile.constraints.size(); ++constraint)
        checkConstraint(problems, profile, constraint);
    checkMuscles(problems, profile);
    const int bodies = static_cast<int>(profile.bodies.size());
    for (std::size_t i = 0; i < profile.filteredPairs.size(); ++i) {
        const auto& [first, second] = profile.filteredPairs[i];
        problems.require(first >= 0 && first < second && second < bodies, fmt::format("/filteredPairs/{}", i),
                         "expected two bodies, the earlier one first");
    }
    return problems.take();
}

}  // namespace lutka::physics
