#include "physics/fit/body_plan.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/aabb.hpp"
#include "core/assert.hpp"
#include "core/quantile.hpp"
#include "physics/fit/body_tips.hpp"
#include "physics/fit/head_skin.hpp"
#include "physics/fit/held_skin.hpp"
#include "physics/fit/odd_pairs.hpp"
#include "physics/fit/skin_regions.hpp"

namespace lutka::physics {
namespace {

using animation::Character;
using animation::HumanoidMap;
using animation::kNoJoint;

Role topmostTrunk(const HumanoidMap& map) {
    for (const Role role : {Role::upperChest, Role::chest, Role::spine}) {
        if (map.jointOf(role) != kNoJoint) return role;
    }
    return Role::hips;
}

bool wantsBody(Role role, const HumanoidMap& map, const FitOptions& options) {
    if (map.jointOf(role) == kNoJoint) return false;
    switch (role) {
        case Role::chest:
        case Role::upperChest:
            return options.allTrunkBodies || role == topmostTrunk(map);
        case Role::neck:
            return options.neckBody;
        case Role::leftShoulder:
        case Role::rightShoulder:
            return options.shoulderBodies;
        case Role::leftToes:
        case Role::rightToes:
            return options.toeBodies;
        default:
            return true;
    }
}

// The roles that may end a role's segment, nearest first.
std::vector<Role> endRoles(Role role) {
    switch (role) {
        case Role::hips:
            return {Role::spine, Role::chest, Role::upperChest, Role::neck, Role::head};
        case Role::spine:
            return {Role::chest, Role::upperChest, Role::neck, Role::head};
        case Role::chest:
            return {Role::upperChest, Role::neck, Role::head};
        case Role::upperChest:
            return {Role::neck, Role::head};
        case Role::neck:
            return {Role::head};
        case Role::leftShoulder:
            return {Role::leftUpperArm};
        case Role::leftUpperArm:
            return {Role::leftLowerArm, Role::leftHand};
        case Role::leftLowerArm:
            return {Role::leftHand};
        case Role::leftUpperLeg:
            return {Role::leftLowerLeg, Role::leftFoot};
        case Role::leftLowerLeg:
            return {Role::leftFoot};
        case Role::head:
        case Role::leftHand:
        case Role::leftFoot:
        case Role::leftToes:
            return {};
        default:
            break;
    }
    std::vector<Role> roles = endRoles(mirrored(role));
    for (Role& end : roles)
        end = mirrored(end);
    return roles;
}

// Roles come parents first in the enumeration; so do the bodies.
void addBodies(BodyPlan& plan, const Character& character, const HumanoidMap& map, std::span<const Role> roles) {
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const Role role = animation::roleAt(index);
        if (std::find(roles.begin(), roles.end(), role) == roles.end() || map.jointOf(role) == kNoJoint) continue;
        PlannedBody body;
        body.name = roleName(role);
        body.role = role;
        body.side = animation::sideOf(role);
        body.joint = map.jointOf(role);
        // A joint that plays two roles carries one body, the upper role's.
        const auto taken = [&](const PlannedBody& other) { return other.joint == body.joint; };
        if (std::any_of(plan.bodies.begin(), plan.bodies.end(), taken)) continue;
        body.start = map.standardFromModel * character.skeleton.bindModelFromJoint[body.joint].translation;
        const auto above = parentRole(role);
        body.parent = above ? bodyCarrying(plan, *above) : -1;
        plan.bodies.push_back(std::move(body));
    }
}

// Behind the bodies with roles.
void addSegments(BodyPlan& plan, const Character& character, const HumanoidMap& map,
                 std::span<const animation::Segment> segments) {
    const int first = static_cast<int>(plan.bodies.size());
    for (const animation::Segment& segment : segments) {
        PlannedBody body;
        body.name = segment.name;
        body.segment = segment;
        if (segment.hinge) body.segment->hinge->axis = map.standardFromModel * segment.hinge->axis;
        body.joint = segment.joint;
        body.side = segment.side;
        body.parent = segment.parent >= 0 ? first + segment.parent : -1;
        body.mirror = segment.mirror >= 0 ? first + segment.mirror : -1;
        body.start = map.standardFromModel * character.skeleton.bindModelFromJoint[body.joint].translation;
        plan.bodies.push_back(std::move(body));
    }
}

void findCounterparts(BodyPlan& plan) {
    for (int index = 0; index < static_cast<int>(plan.bodies.size()); ++index) {
        PlannedBody& body = plan.bodies[index];
        if (body.role) body.mirror = body.side == animation::Side::center ? index : plan.bodyOf(mirrored(*body.role));
    }
}

// The joint of each role that has one, or kNoJoint's place: joint -> role index, -1 where there is none.
std::vector<int> rolesOfJoints(const Character& character, const HumanoidMap& map) {
    std::vector<int> roleOf(character.skeleton.parents.size(), -1);
    for (int index = 0; index < animation::kRoleCount; ++index) {
        const int joint = map.jointOf(animation::roleAt(index));
        if (joint != kNoJoint) roleOf[joint] = index;
    }
    return roleOf;
}

float distanceToSegment(const vec3& point, const vec3& start, const vec3& end) {
    const vec3 along = end - start;
    const float square = glm::dot(along, along);
    const float t = square > 0.0F ? std::clamp(glm::dot(point - start, along) / square, 0.0F, 1.0F) : 0.0F;
    return glm::distance(point, start + t * along);
}

int nearestBody(const BodyPlan& plan, const vec3& point) {
    int nearest = 0;
    float least = distanceToSegment(point, plan.bodies[0].start, plan.bodies[0].end);
    for (std::size_t body = 1; body < plan.bodies.size(); ++body) {
        const float distance = distanceToSegment(point, plan.bodies[body].start, plan.bodies[body].end);
        if (distance < least) {
            least = distance;
            nearest = static_cast<int>(body);
        }
    }
    return nearest;
}

void assignJoints(BodyPlan& plan, const Character& character, const HumanoidMap& map) {
    const animation::Skeleton& skeleton = character.skeleton;
    const std::vector<int> roleOf = rolesOfJoints(character, map);
    plan.bodyOfJoint.assign(skeleton.parents.size(), -1);
    std::vector<int> segmentOf(skeleton.parents.size(), -1);
    for (std::size_t body = 0; body < plan.bodies.size(); ++body) {
        if (plan.bodies[body].segment) segmentOf[plan.bodies[body].joint] = static_cast<int>(body);
    }
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (segmentOf[joint] >= 0) {
            plan.bodyOfJoint[joint] = segmentOf[joint];
        } else if (roleOf[joint] >= 0) {
            plan.bodyOfJoint[joint] = bodyCarrying(plan, animation::roleAt(roleOf[joint]));
        } else if (skeleton.parents[joint] != kNoJoint) {
            plan.bodyOfJoint[joint] = plan.bodyOfJoint[skeleton.parents[joint]];
        }
    }
    // Of a creature all above the root belongs to the root; its controls may lie anywhere.
    for (int joint = plan.bodies[0].role ? kNoJoint : skeleton.parents[plan.bodies[0].joint]; joint != kNoJoint;
         joint = skeleton.parents[joint])
        plan.bodyOfJoint[joint] = 0;
    for (int joint = 0; joint < skeleton.jointCount(); ++joint) {
        if (plan.bodyOfJoint[joint] >= 0) continue;
        plan.bodyOfJoint[joint] =
            nearestBody(plan, map.standardFromModel * skeleton.bindModelFromJoint[joint].translation);
    }
}

bool isLeg(std::optional<Role> role) {
    return isEitherSide(role, Role::leftUpperLeg) || isEitherSide(role, Role::leftLowerLeg) ||
           isEitherSide(role, Role::leftFoot);
}

// The body of a part whose segment is nearest.
int nearestPart(const BodyPlan& plan, const vec3& point) {
    const auto distanceTo = [&](const PlannedBody& body) {
        return body.role ? distanceToSegment(point, body.start, body.end) : std::numeric_limits<float>::max();
    };
    const auto nearest = std::min_element(
        plan.bodies.begin(), plan.bodies.end(),
        [&](const PlannedBody& first, const PlannedBody& second) { return distanceTo(first) < distanceTo(second); });
    return static_cast<int>(nearest - plan.bodies.begin());
}

// The segments that hang on a part with a role, which is known only when every joint has its body. What hangs above the
// hips, on the root of the file, is the part's that it lies at.
void hangSegments(BodyPlan& plan, const Character& character) {
    if (plan.bodies.empty() || !plan.bodies[0].role) return;
    for (PlannedBody& body : plan.bodies) {
        if (!body.segment || body.parent >= 0) continue;
        const int above = character.skeleton.parents[body.joint];
        const int hips = plan.bodies[0].joint;
        const bool beside =
            above == kNoJoint || (above != hips && animation::isAncestorOrSelf(character.skeleton, above, hips));
        body.parent = beside ? nearestPart(plan, body.start) : plan.bodyOfJoint[above];
    }
}

// The vertical extent of a creature, at least half of its longest: of its skin, else of its joints.
float creatureSize(const BodyPlan& plan, const Character& character, const HumanoidMap& map) {
    Aabb box;
    for (const PlannedBody& body : plan.bodies) {
        for (const SkinPoint& point : body.skin)
            box.add(point.position);
    }
    if (box.empty()) {
        for (const RigidTransform& joint : character.skeleton.bindModelFromJoint)
            box.add(map.standardFromModel * joint.translation);
    }
    const vec3 size = box.size();
    return std::max({size.y, 0.5F * size.x, 0.5F * size.z, 1e-3F});
}

void findSegmentEnd(PlannedBody& body, const Character& character, const HumanoidMap& map, float shortest) {
    const int end = body.segment->end;
    body.end = body.start + vec3(0, shortest, 0);
    if (end == kNoJoint) return;
    const vec3 at = map.standardFromModel * character.skeleton.bindModelFromJoint[end].translation;
    if (glm::distance(at, body.start) < shortest) return;
    body.end = at;
    body.endsAtJoint = true;
}

// Crown minus sole: from the skin of the head (or of the trunk, where it has none) and of the legs, else from the
// joints (the head joint of a man lies at 0.89 of his height, the ankle at 0.05: hence the factor).
float figureHeight(const BodyPlan& plan, float jointSpanM) {
    std::vector<SkinPoint> low;
    std::vector<SkinPoint> high;
    const int head = plan.bodyOf(Role::head);
    const bool headHasSkin = head >= 0 && !plan.bodies[head].skin.empty();
    for (const PlannedBody& body : plan.bodies) {
        if (!body.role) continue;
        if (body.role == Role::head || (!headHasSkin && body.side == animation::Side::center)) {
            high.insert(high.end(), body.skin.begin(), body.skin.end());
        }
        if (isLeg(body.role)) low.insert(low.end(), body.skin.begin(), body.skin.end());
    }
    constexpr float kJointsOfHeight = 0.84F;
    const float fromJoints = jointSpanM / kJointsOfHeight;
    if (low.empty() || high.empty()) return fromJoints;
    const auto y = [](const SkinPoint& point) { return point.position.y; };
    const float fromSkin = quantileOf(high, 0.99F, y) - quantileOf(low, 0.005F, y);
    return fromSkin > 0.5F * fromJoints ? fromSkin : fromJoints;
}

// Vertical extent of the bodies' joints.
float jointSpan(const BodyPlan& plan) {
    float low = plan.bodies[0].start.y;
    float high = low;
    for (const PlannedBody& body : plan.bodies) {
        if (body.segment && plan.bodies[0].role) continue;
        low = std::min(low, body.start.y);
        high = std::max(high, body.start.y);
    }
    return std::max(high - low, 1e-3F);
}

void findEnds(BodyPlan& plan, const Character& character, const HumanoidMap& map) {
    for (PlannedBody& body : plan.bodies) {
        if (body.segment) findSegmentEnd(body, character, map, 1e-3F * plan.heightM);
        if (!body.role) continue;
        const vec3 standing = body.side == animation::Side::right ? standingDirection(*body.role) * vec3(-1, 1, 1)
                                                                  : standingDirection(*body.role);
        const int above = body.parent;
        // Without anything else a tip continues the limb.
        const bool continues = above >= 0 && plan.bodies[above].endsAtJoint && body.role != Role::leftFoot &&
                               body.role != Role::rightFoot && body.role != Role::head;
        const vec3 direction = continues ? plan.bodies[above].direction() : standing;
        body.end = body.start + direction * (0.1F * plan.heightM);
        for (const Role role : endRoles(*body.role)) {
            const int joint = map.jointOf(role);
            if (joint == kNoJoint || (animation::isSpine(role) && plan.bodyOf(role) < 0)) continue;
            const vec3 end = map.standardFromModel * character.skeleton.bindModelFromJoint[joint].translation;
            if (glm::distance(end, body.start) < 1e-3F * plan.heightM) continue;
            body.end = end;
            body.endsAtJoint = true;
            break;
        }
    }
}

// Some figures have parts that were modelled in place, with their joints left at the origin. Where all joints stand in
// one place, or the two of every pair do, they say nothing about where the figure's middle is.
bool tellsMiddle(const BodyPlan& plan) {
    if (plan.bodies.size() == 1) return true;
    const float apart = kSymmetryTolerance * plan.heightM;
    bool pairs = false;
    bool spread = false;
    for (const PlannedBody& body : plan.bodies) {
        spread = spread || glm::distance(body.start, plan.bodies[0].start) > apart;
        if (body.side != animation::Side::left || body.mirror < 0) continue;
        if (glm::distance(body.start, plan.bodies[body.mirror].start) > apart) return true;
        pairs = true;
    }
    return spread && !pairs;
}

bool isSymmetric(const BodyPlan& plan) {
    if (!tellsMiddle(plan)) return false;
    for (const PlannedBody& body : plan.bodies) {
        // What hangs on a humanoid says nothing about its symmetry.
        if (body.side != animation::Side::left || (body.segment && (body.mirror < 0 || plan.bodies[0].role))) continue;
        const int other = body.mirror;
        if (other < 0) return false;
        const float off = glm::distance(plan.mirror(body.start), plan.bodies[other].start);
        if (off > kSymmetryTolerance * plan.heightM) return false;
    }
    return true;
}

void findMiddle(BodyPlan& plan) {
    float sum = 0.0F;
    int count = 0;
    float pairSum = 0.0F;
    int pairCount = 0;
    for (const PlannedBody& body : plan.bodies) {
        if (body.side == animation::Side::left && body.mirror >= 0) {
            pairSum += 0.5F * (body.start.x + plan.bodies[body.mirror].start.x);
            ++pairCount;
        }
        if (body.mirror == static_cast<int>(&body - plan.bodies.data()) && (body.role || !plan.bodies[0].role)) {
            sum += body.start.x;
            ++count;
        }
    }
    if (count > 0) {
        plan.middleX = sum / static_cast<float>(count);
    } else {
        plan.middleX = pairCount > 0 ? pairSum / static_cast<float>(pairCount) : plan.bodies[0].start.x;
    }
    plan.symmetric = isSymmetric(plan);
    if (plan.symmetric) findOddPairs(plan);
}

}  // namespace

vec3 PlannedBody::direction() const {
    return glm::normalize(end - start);
}

float PlannedBody::length() const {
    return glm::distance(end, start);
}

int BodyPlan::bodyOf(Role role) const {
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        if (bodies[body].role == role) return static_cast<int>(body);
    }
    return -1;
}

int BodyPlan::bodyNamed(std::string_view name) const {
    for (std::size_t body = 0; body < bodies.size(); ++body) {
        if (bodies[body].name == name) return static_cast<int>(body);
    }
    return -1;
}

vec3 standingDirection(Role role) {
    switch (sideOf(role) == animation::Side::right ? mirrored(role) : role) {
        case Role::leftShoulder:
            return {1, 0, 0};
        case Role::leftUpperArm:
        case Role::leftLowerArm:
        case Role::leftHand:
        case Role::leftUpperLeg:
        case Role::leftLowerLeg:
            return {0, -1, 0};
        case Role::leftFoot:
        case Role::leftToes:
            return {0, 0, 1};
        default:
            return {0, 1, 0};
    }
}

int bodyCarrying(const BodyPlan& plan, Role role) {
    for (std::optional<Role> at = role; at; at = animation::parentRole(*at)) {
        const int body = plan.bodyOf(*at);
        if (body >= 0) return body;
    }
    return 0;
}

BodyPlan planBodies(const Character& character, const HumanoidMap& map, const FitOptions& options,
                    std::span<const animation::Segment> segments) {
    std::vector<Role> roles;
    for (int index = 0; index < animation::kRoleCount; ++index) {
        if (wantsBody(animation::roleAt(index), map, options)) roles.push_back(animation::roleAt(index));
    }
    return planBodies(character, map, roles, segments);
}

BodyPlan planBodies(const Character& character, const HumanoidMap& map, std::span<const Role> roles,
                    std::span<const animation::Segment> segments) {
    LUTKA_ASSERT(!roles.empty() || !segments.empty());
    BodyPlan plan;
    addBodies(plan, character, map, roles);
    addSegments(plan, character, map, segments);
    findCounterparts(plan);
    plan.heightM = jointSpan(plan);
    findEnds(plan, character, map);
    assignJoints(plan, character, map);
    hangSegments(plan, character);
    const std::vector<animation::Appendage> appendages =
        map.humanoid ? animation::findAppendages(character, map) : std::vector<animation::Appendage>{};
    plan.held = jointsOfHeldWeapons(plan, character, appendages);
    const std::vector<SkinPoint> hanging =
        gatherSkin(plan, character, map.standardFromModel, jointsHangingOnHead(plan, character, appendages), plan.held);
    hangOnHead(plan, hanging);
    plan.heightM = roles.empty() ? creatureSize(plan, character, map) : figureHeight(plan, jointSpan(plan));
    settleHeadSkin(plan, hanging);
    findEnds(plan, character, map);
    balanceTrunk(plan);
    findTips(plan, character, map);
    findMiddle(plan);
    return plan;
}

}  // namespace lutka::physics
