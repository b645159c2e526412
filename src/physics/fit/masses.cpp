#include "physics/fit/masses.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/assert.hpp"
#include "physics/collision/shape.hpp"

namespace lutka::physics {
namespace {

// Shares of the whole body, limbs a side.
struct MassColumn {
    float head, upperTrunk, middleTrunk, lowerTrunk, upperArm, forearm, hand, thigh, shank, foot;
};

const MassColumn& columnOf(MassTable table) {
    static constexpr MassColumn kMale{.0694F, .1596F, .1633F, .1117F, .0271F, .0162F, .0061F, .1416F, .0433F, .0137F};
    static constexpr MassColumn kFemale{.0668F, .1545F, .1465F, .1247F, .0255F, .0138F, .0056F, .1478F, .0481F, .0129F};
    static constexpr MassColumn kWinter{.081F, .216F, .139F, .142F, .028F, .016F, .006F, .100F, .0465F, .0145F};
    switch (table) {
        case MassTable::deLevaFemale:
            return kFemale;
        case MassTable::winter:
            return kWinter;
        case MassTable::deLevaMale:
            break;
    }
    return kMale;
}

bool hasBody(Role role, std::span<const BodyProfile> bodies) {
    return std::any_of(bodies.begin(), bodies.end(), [&](const BodyProfile& body) { return body.role == role; });
}

// What no table knows (tails, hair, capes) has half the density of the parts that it does: much of it is cloth or hair.
void addShareless(std::span<const BodyProfile> bodies, std::vector<double>& shares) {
    constexpr double kDensity = 0.5;
    double volume = 0.0;
    double share = 0.0;
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        if (bodies[body].role) volume += shapeVolume(bodies[body].shape);
        share += shares[body];
    }
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        if (!bodies[body].role && volume > 0.0)
            shares[body] = kDensity * share * shapeVolume(bodies[body].shape) / volume;
    }
}

// Table shares gathered by the bodies that carry them.
std::vector<double> tableShares(std::span<const BodyProfile> bodies, MassTable table) {
    std::vector<double> shares(bodies.size(), 0.0);
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role carrier = carrierOf(animation::roleAt(index), bodies);
        for (std::size_t body = 0; body < bodies.size(); ++body) {
            if (bodies[body].role == carrier) shares[body] += segmentMassShare(table, animation::roleAt(index));
        }
    }
    addShareless(bodies, shares);
    return shares;
}

std::vector<double> rootsOf(std::vector<double> shares) {
    for (double& share : shares)
        share = std::sqrt(share);
    return shares;
}

std::vector<double> sharesOf(std::span<const BodyProfile> bodies, const FitOptions& options) {
    if (options.massPreset == MassPreset::uniform) return std::vector<double>(bodies.size(), 1.0);
    const bool anyRole = std::any_of(bodies.begin(), bodies.end(), [](const BodyProfile& b) { return b.role; });
    if (options.massPreset == MassPreset::volume || !anyRole) {
        std::vector<double> shares;
        shares.reserve(bodies.size());
        for (const BodyProfile& body : bodies)
            shares.push_back(shapeVolume(body.shape));
        return options.massPreset == MassPreset::balanced ? rootsOf(std::move(shares)) : shares;
    }
    std::vector<double> shares = tableShares(bodies, options.massTable);
    return options.massPreset == MassPreset::balanced ? rootsOf(std::move(shares)) : shares;
}

// The arm or leg that a role belongs to, from the trunk outwards; empty for the trunk's roles.
std::vector<Role> limbOf(Role role) {
    const bool right = sideOf(role) == animation::Side::right;
    std::vector<Role> arm{Role::leftUpperArm, Role::leftLowerArm, Role::leftHand};
    std::vector<Role> leg{Role::leftUpperLeg, Role::leftLowerLeg, Role::leftFoot, Role::leftToes};
    for (std::vector<Role>& limb : {std::ref(arm), std::ref(leg)}) {
        if (right) std::transform(limb.begin(), limb.end(), limb.begin(), animation::mirrored);
        if (std::find(limb.begin(), limb.end(), role) != limb.end()) return limb;
    }
    return {};
}

}  // namespace

float segmentMassShare(MassTable table, Role role) {
    constexpr float kNeckOfHead = 0.2F;
    constexpr float kShoulderOfTrunk = 0.1F;
    constexpr float kToesOfFoot = 0.2F;
    const MassColumn& column = columnOf(table);
    const float upperTrunk = column.upperTrunk * (1.0F - 2.0F * kShoulderOfTrunk);
    switch (role) {
        case Role::hips:
            return column.lowerTrunk;
        case Role::spine:
            return column.middleTrunk;
        case Role::chest:
        case Role::upperChest:
            return 0.5F * upperTrunk;
        case Role::neck:
            return kNeckOfHead * column.head;
        case Role::head:
            return (1.0F - kNeckOfHead) * column.head;
        case Role::leftShoulder:
        case Role::rightShoulder:
            return kShoulderOfTrunk * column.upperTrunk;
        case Role::leftUpperArm:
        case Role::rightUpperArm:
            return column.upperArm;
        case Role::leftLowerArm:
        case Role::rightLowerArm:
            return column.forearm;
        case Role::leftHand:
        case Role::rightHand:
            return column.hand;
        case Role::leftUpperLeg:
        case Role::rightUpperLeg:
            return column.thigh;
        case Role::leftLowerLeg:
        case Role::rightLowerLeg:
            return column.shank;
        case Role::leftFoot:
        case Role::rightFoot:
            return (1.0F - kToesOfFoot) * column.foot;
        case Role::leftToes:
        case Role::rightToes:
            return kToesOfFoot * column.foot;
    }
    return 0.0F;
}

Role carrierOf(Role role, std::span<const BodyProfile> bodies) {
    // De Leva's head segment includes the neck, and Winter's likewise; the tree of roles would give it to the trunk.
    if (role == Role::neck && !hasBody(role, bodies) && hasBody(Role::head, bodies)) return Role::head;
    // One body for the whole upper trunk may be the chest's or, above it, the upper chest's.
    if (role == Role::chest && !hasBody(role, bodies) && hasBody(Role::upperChest, bodies)) return Role::upperChest;
    // An arm that is a hand alone carries all of the arm.
    const std::vector<Role> limb = limbOf(role);
    const auto own = std::find(limb.begin(), limb.end(), role);
    const auto carries = [&](Role other) { return hasBody(other, bodies); };
    if (std::none_of(limb.begin(), own, carries)) {
        const auto below = std::find_if(own, limb.end(), carries);
        if (below != limb.end()) return *below;
    }
    for (std::optional<Role> at = role; at; at = animation::parentRole(*at)) {
        if (hasBody(*at, bodies)) return *at;
    }
    return Role::hips;
}

void assignMasses(std::span<BodyProfile> bodies, const FitOptions& options) {
    LUTKA_ASSERT(!bodies.empty() && options.totalMassKg > 0.0F);
    const std::vector<double> shares = sharesOf(bodies, options);
    const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
    double rest = options.totalMassKg;
    std::size_t heaviest = 0;
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        bodies[body].massKg = static_cast<float>(options.totalMassKg * shares[body] / sum);
        rest -= bodies[body].massKg;
        if (bodies[body].massKg > bodies[heaviest].massKg) heaviest = body;
    }
    // What rounding to float left over.
    bodies[heaviest].massKg = static_cast<float>(bodies[heaviest].massKg + rest);
    for (BodyProfile& body : bodies)
        body.inertia = shapeInertia(body.shape, body.massKg);
}

void raiseLightSegments(RagdollProfile& profile) {
    constexpr float kLeastOfChild = 0.7F;
    constexpr float kLeastOfParent = 0.2F;
    const auto raise = [&](int light, float massKg) {
        BodyProfile& body = profile.bodies[light];
        if (!body.role) body.massKg = std::max(body.massKg, massKg);
    };
    // Up the tree, then down: what was raised may be too heavy for what hangs on it.
    for (auto c = profile.constraints.rbegin(); c != profile.constraints.rend(); ++c)
        raise(c->parent, kLeastOfChild * profile.bodies[c->child].massKg);
    for (const ConstraintProfile& constraint : profile.constraints)
        raise(constraint.child, kLeastOfParent * profile.bodies[constraint.parent].massKg);
    float sum = 0.0F;
    for (const BodyProfile& body : profile.bodies)
        sum += body.massKg;
    const float scale = profile.totalMassKg / sum;
    for (BodyProfile& body : profile.bodies) {
        body.massKg *= scale;
        body.inertia = shapeInertia(body.shape, body.massKg);
    }
}

}  // namespace lutka::physics
