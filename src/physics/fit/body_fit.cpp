#include "physics/fit/body_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/quantile.hpp"
#include "physics/fit/body_tips.hpp"
#include "physics/fit/few_points.hpp"
#include "physics/fit/fit_measures.hpp"
#include "physics/fit/principal_axes.hpp"
#include "physics/fit/radius_share.hpp"
#include "physics/fit/several_capsules.hpp"

namespace lutka::physics {
namespace {

constexpr std::size_t kCorners = 8;
constexpr float kClearly = 0.85F;         // of a cost: another way to lie is clearly nearer
constexpr float kSmallestRadius = 0.01F;  // of the height, like the next
constexpr float kLargestRadius = 0.15F;
constexpr float kLargestHeadRadius = 0.3F;
// Skin further than this from the surface counts no more than that; of the height.
constexpr float kCutoff = 0.04F;
// How far a limb's cap may reach past its joint, in radii: enough to close the knee, not to look like a sausage.
constexpr float kOvershoot = 0.5F;
constexpr float kRadiusOfLength = 0.15F;  // of a segment without skin
// A foot presses on the ground no farther out than its caps' centres: so they lie nearer to heel and toe tip than by
// their radius. Of the radius, and how far a cap may come out of the skin for that, of the height.
constexpr float kHeelInset = 0.6F;
constexpr float kHeelBeyond = 0.012F;
constexpr float kFootRadius = 0.35F;  // at most, of the foot's length

// The limits that keep a searched capsule what its segment is: `settle` clamps a trial.
void settleLimb(CapsuleTrial& trial, float length) {
    // Caps end within kOvershoot radii of the joints; the axis keeps within 0.6 radii of the line between them.
    const float reach = kOvershoot * trial.radius;
    const float longest = std::max(0.0F, 0.5F * length + reach - trial.radius);
    trial.halfLength = std::clamp(trial.halfLength, 0.0F, longest);
    const float slack = longest - trial.halfLength;
    trial.center.y = std::clamp(trial.center.y, 0.5F * length - slack, 0.5F * length + slack);
    const float aside = std::hypot(trial.center.x, trial.center.z);
    const float most = 0.6F * trial.radius;
    if (aside > most) {
        trial.center.x *= most / aside;
        trial.center.z *= most / aside;
    }
}

}  // namespace

quat axesAlong(const vec3& direction) {
    const vec3 ahead = std::abs(direction.z) < 0.9F ? vec3(0, 0, 1) : vec3(0, 1, 0);
    const vec3 x = glm::normalize(glm::cross(direction, ahead));
    return glm::normalize(glm::quat_cast(mat3(x, direction, glm::cross(x, direction))));
}

BodyFit::BodyFit(const BodyPlan& plan, const Anatomy& anatomy, int body)
    : plan_(plan), body_(plan.bodies[body]), rotation_(anatomy.standardFromAnatomy[body]) {
    points_ = skinNearSegment(plan, body_);
    central_ = plan.symmetric && body_.mirror == body;
    standsOn_ = isLastOfLeg(body);
    if (central_ || plan.isPaired(body_)) addMirrored();
    if (points_.size() >= kFewestShapePoints) spread_ = principalAxes(points_).spread[1];
}

Capsule BodyFit::fit() const {
    // A segment is where its skin is, not where its joint points.
    if (points_.size() < kFewestShapePoints && body_.segment && !points_.empty()) {
        return capsuleAlong(points_, {central_, plan_.middleX, kSmallestRadius * plan_.heightM, largestRadius()});
    }
    if (points_.size() < kFewestShapePoints) return byProportions();
    if (isFoot()) return fitFoot();
    if (isTrunk(body_.role) || body_.role == Role::head) return fitStandingOrLying();
    if (body_.segment) return fitSegment();
    return body_.endsAtJoint ? fitLimb() : fitEnd();
}

std::optional<std::vector<Capsule>> BodyFit::fitSeveral(const Capsule& single, int most) const {
    const bool trunk = isTrunk(body_.role) || body_.role == Role::head || (body_.segment && central_);
    if (most < 2 || !trunk || points_.size() < kFewestShapePoints) return std::nullopt;
    CapsuleBounds bounds;
    const vec3 origin(central_ ? plan_.middleX : body_.start.x, body_.start.y, body_.start.z);
    bounds.standardFromAxes = {central_ ? inMirrorPlane(rotation_) : rotation_, origin};
    bounds.symmetric = central_;
    bounds.smallestRadius = 0.02F * plan_.heightM;
    bounds.largestRadius = largestRadius();
    bounds.cutoff = cutoff();
    bounds.nearM = kNearSkin * plan_.heightM;
    return fitSeveralCapsules(points_, single, bounds, most);
}

std::optional<PlacedBox> BodyFit::fitBox(const Capsule& capsule) const {
    // The corners of a creature's block say enough of it; a man's part of few points has a man's measures.
    const std::size_t fewest = body_.segment ? kCorners : kFewestShapePoints;
    if (points_.size() < fewest || isWhatStands()) return std::nullopt;
    BoxBounds bounds;
    const bool stands = central_ || isTrunk(body_.role) || body_.role == Role::head;
    bounds.standardFromAxes = central_ ? inMirrorPlane(rotation_) : stands ? rotation_ : axesAlong(body_.direction());
    bounds.turnAxis = stands ? vec3(1, 0, 0) : vec3(0, 1, 0);
    bounds.alsoUpright = !stands;
    bounds.symmetric = central_;
    bounds.middleX = plan_.middleX;
    bounds.smallestHalf = kSmallestRadius * plan_.heightM;
    bounds.largestHalf = largestRadius() + body_.length();
    bounds.cutoff = cutoff();
    bounds.nearM = kNearSkin * plan_.heightM;
    std::optional<PlacedBox> box = physics::fitBox(points_, capsule, bounds);
    // A segment's joint may stand anywhere about its skin: along that, or upright.
    const std::array<quat, 2> further{axesAlong(principalAxes(points_).axis[0]), quat(1, 0, 0, 0)};
    for (std::size_t i = 0; i < further.size() && !box && body_.segment && !central_; ++i) {
        bounds.standardFromAxes = further[i];
        box = physics::fitBox(points_, capsule, bounds);
    }
    // About a joint that bends, a limb's box about one of its ends would turn into its neighbour.
    constexpr float kOfLength = 0.2F;
    const float middle = box ? glm::dot(box->standardFromBox.translation - body_.start, body_.direction()) : 0.0F;
    const bool between = middle > kOfLength * body_.length() && middle < (1.0F - kOfLength) * body_.length();
    return stands || between || body_.parent < 0 ? box : std::nullopt;
}

// The turn about x that is in a rotation of a body in the middle.
quat BodyFit::inMirrorPlane(const quat& rotation) {
    const quat turn(rotation.w, rotation.x, 0, 0);
    return glm::dot(turn, turn) > 1e-6F ? glm::normalize(turn) : quat(1, 0, 0, 0);
}

bool BodyFit::isFoot() const {
    return isEitherSide(body_.role, Role::leftFoot) || isEitherSide(body_.role, Role::leftToes);
}

// The lowest body of a leg. It stays round where it meets the ground: on flat ends a limp figure would go on
// standing.
bool BodyFit::isWhatStands() const {
    if (body_.segment) return standsOn_;
    const auto has = [&](Role left) { return plan_.bodyOf(left) >= 0 && plan_.bodyOf(mirrored(left)) >= 0; };
    const bool shin = isEitherSide(body_.role, Role::leftLowerLeg) && !has(Role::leftFoot);
    const bool leg = isEitherSide(body_.role, Role::leftUpperLeg) && !has(Role::leftLowerLeg);
    return isFoot() || shin || leg;
}

// A creature's limb that goes down and that nothing hangs on.
bool BodyFit::isLastOfLeg(int index) const {
    constexpr float kDown = 0.8F;
    using Kind = animation::Segment::Kind;
    if (!body_.segment || (body_.segment->kind != Kind::limbRoot && body_.segment->kind != Kind::limb)) return false;
    return body_.direction().y < -kDown && std::none_of(plan_.bodies.begin(), plan_.bodies.end(),
                                                        [&](const PlannedBody& b) { return b.parent == index; });
}

float BodyFit::largestRadius() const {
    const bool head = body_.role == Role::head;
    const float share = head ? kLargestHeadRadius : isTrunk(body_.role) ? kLargestTrunkRadius : kLargestRadius;
    return plan_.heightM * (body_.segment ? kLargestSegmentRadius : share);
}

float BodyFit::cutoff() const {
    return std::max(kCutoff * plan_.heightM, (body_.role == Role::head ? 1.0F : 0.5F) * spread_);
}

// Both sides of a symmetric figure tell about one shape, but for the one that holds something.
void BodyFit::addMirrored() {
    const PlannedBody& other = plan_.bodies[body_.mirror];
    if (!central_ && other.holds) return;
    if (!central_ && body_.holds) points_.clear();
    const vec3 shift = body_.start - plan_.mirror(other.start);
    for (const SkinPoint& point : skinNearSegment(plan_, other))
        points_.push_back({plan_.mirror(point.position) + (central_ ? vec3(0) : shift), point.area});
}

CapsuleSearch BodyFit::searchAlong(const vec3& origin, const quat& axes) const {
    return {points_, {axes, origin}, plan_.heightM * kSmallestRadius, largestRadius(), cutoff()};
}

Capsule BodyFit::fitLimb() const {
    const CapsuleSearch search = searchAlong(body_.start, axesAlong(body_.direction()));
    const float length = body_.length();
    CapsuleTrial trial;
    trial.radius = search.radiusAboutAxis(0.15F * length, 0.85F * length);
    trial.center = {0, 0.5F * length, 0};
    trial.halfLength = 0.5F * length;
    return search.run(trial, [&](CapsuleTrial& t) {
        t.radius = std::min(t.radius, std::max(0.6F * length, 0.02F * plan_.heightM));
        settleLimb(t, length);
    });
}

// The last body of a limb: along the way from its joint into its skin, or along the skin's own length where the
// joint stands beside it, as of a block that hangs before or behind its joint.
Capsule BodyFit::fitEnd() const {
    constexpr float kLong = 1.5F;  // ratio of the spreads
    Capsule limb = fitLimb();
    const PrincipalAxes axes = principalAxes(points_);
    if (axes.spread[0] < kLong * axes.spread[1]) return limb;
    const CapsuleSearch search = searchAlong(body_.start, axesAlong(axes.axis[0]));
    Capsule own = fitFree(search);
    const vec3 away = body_.start - own.start;
    const float beside = glm::length(away - glm::dot(away, axes.axis[0]) * axes.axis[0]);
    return beside > own.radius && search.cost(own) < kClearly * search.cost(limb) ? own : limb;
}

// Along the segment like a limb, or anywhere along it or along the skin's own length, where that is clearly nearer:
// a creature's trunk and head are longer and fatter than the way between their joints.
Capsule BodyFit::fitSegment() const {
    const vec3 along = body_.direction();
    const CapsuleSearch search = searchAlong(body_.start, axesAlong(along));
    Capsule best = fitLimb();
    const auto kind = body_.segment->kind;
    const bool limb = kind == animation::Segment::Kind::limbRoot || kind == animation::Segment::Kind::limb;
    if (limb && body_.endsAtJoint) return best;
    float least = kClearly * search.cost(best);
    std::vector<vec3> directions{along};
    const vec3 longest = principalAxes(points_).axis[0];
    // In the middle of a symmetric creature a capsule stands in the mirror plane or lies across it.
    if (!central_) directions.push_back(longest);
    if (central_) directions.push_back(std::abs(longest.x) > 0.7F ? vec3(1, 0, 0) : inMirrorPlane(longest));
    for (const vec3& direction : directions) {
        const CapsuleSearch other = searchAlong(body_.start, axesAlong(direction));
        const Capsule capsule = fitFree(other);
        const float cost = other.cost(capsule);
        if (cost >= least) continue;
        least = cost;
        best = capsule;
    }
    return best;
}

vec3 BodyFit::inMirrorPlane(const vec3& direction) {
    const vec3 flat(0, direction.y, direction.z);
    return glm::length(flat) > 1e-3F ? glm::normalize(flat) : vec3(0, 0, 1);
}

// Standing or lying across: whichever lies nearer to the skin. A head also ahead, where that is clearly nearer: one
// with a beak or a snout.
Capsule BodyFit::fitStandingOrLying() const {
    const std::array<vec3, 3> directions{rotation_ * vec3(0, 1, 0), rotation_ * vec3(1, 0, 0),
                                         rotation_ * vec3(0, 0, 1)};
    Capsule best;
    float least = 0.0F;
    const std::size_t tried = body_.role == Role::head ? 3 : 2;
    for (std::size_t i = 0; i < tried; ++i) {
        const vec3 origin(plan_.middleX, body_.start.y, body_.start.z);
        const CapsuleSearch search = searchAlong(origin, axesAlong(directions[i]));
        const Capsule capsule = fitFree(search);
        const float cost = search.cost(capsule);
        if (i == 0 || cost < (i == 2 ? kClearly : 1.0F) * least) {
            least = cost;
            best = capsule;
        }
    }
    return best;
}

// Anywhere, as long as its tips stay with the skin.
Capsule BodyFit::fitFree(const CapsuleSearch& search) const {
    const auto ends = search.quantiles(0.01F, 0.99F);
    const float low = ends.first.y;
    const float high = ends.second.y;
    return search.run(search.boundingTrial(), [&](CapsuleTrial& t) {
        keepCentral(t, search);
        const float spare = 0.1F * t.radius;
        const float longest = std::max(0.0F, 0.5F * (high - low) + spare - t.radius);
        t.halfLength = std::min(t.halfLength, longest);
        const float slack = longest - t.halfLength;
        t.center.y = std::clamp(t.center.y, 0.5F * (low + high) - slack, 0.5F * (low + high) + slack);
    });
}

float BodyFit::heelInset(float radius) const {
    return std::max(kHeelInset * radius, radius - kHeelBeyond * plan_.heightM);
}

// Along the sole and touching it, from heel to toe tip.
Capsule BodyFit::fitFoot() const {
    const CapsuleSearch search = searchAlong(body_.start, axesAlong(rotation_ * vec3(0, 0, 1)));
    const auto corners = search.quantiles(0.02F, 0.98F);
    const vec3 low = corners.first;
    const vec3 high = corners.second;
    const vec3 up = search.inSearch(rotation_ * vec3(0, 1, 0));
    // The search's axes across the foot: which of x and z is up depends on the heading.
    const int vertical = std::abs(up.x) > std::abs(up.z) ? 0 : 2;
    const float sole = up[vertical] > 0.0F ? low[vertical] : high[vertical];
    const float sign = up[vertical] > 0.0F ? 1.0F : -1.0F;
    const int lateral = 2 - vertical;
    const float width = high[lateral] - low[lateral];
    // A stub that is as wide as long stands on more than one point, too.
    const float thickest = kFootRadius * (high.y - low.y);
    CapsuleTrial trial;
    trial.radius = std::max(0.4F * width, kSmallestRadius * plan_.heightM);
    trial.center = 0.5F * (low + high);
    return search.run(trial, [&](CapsuleTrial& t) {
        t.radius = std::min(std::clamp(t.radius, 0.3F * width, 0.5F * width), thickest);
        t.center[vertical] = sole + sign * t.radius;
        t.center.y = 0.5F * (low.y + high.y);
        t.halfLength = std::max(0.0F, 0.5F * (high.y - low.y) - heelInset(t.radius));
    });
}

void BodyFit::keepCentral(CapsuleTrial& trial, const CapsuleSearch& search) const {
    if (!central_) return;
    vec3 center = search.inStandard(trial.center);
    center.x = plan_.middleX;
    trial.center = search.toSearch(center);
}

// A man's measures, for figures without a skin and bodies without a share of it.
Capsule BodyFit::byProportions() const {
    const std::optional<Role> role = body_.role;
    const float length = body_.length();
    float radius = role ? radiusShare(*role) * plan_.heightM : kRadiusOfLength * length;
    if (isTrunk(role)) return trunkByProportions(radius);
    radius = std::min(radius, std::max(0.35F * length, kSmallestRadius * plan_.heightM));
    vec3 start = body_.start;
    vec3 end = body_.end;
    float beyond = kOvershoot * radius;
    if (isFoot()) {
        // The ankle stands 0.04 of the height above the sole and a quarter of the foot ahead of the heel; a foot is
        // 0.152 of the height long (Drillis and Contini 1966), however far the joints of its toes reach.
        constexpr float kAheadOfAnkle = 0.152F - 0.0375F;
        const bool whole = isEitherSide(role, Role::leftFoot);
        const vec3 ahead = rotation_ * vec3(0, 0, 1);
        start += vec3(0, radius - (whole ? 0.04F : 0.01F) * plan_.heightM, 0);
        end = start + ahead * std::clamp(length, 0.04F * plan_.heightM, kAheadOfAnkle * plan_.heightM);
        start -= ahead * ((whole ? 0.0375F : 0.02F) * plan_.heightM);
        beyond = radius - heelInset(radius);
    }
    const vec3 along = glm::normalize(end - start);
    const float inset = std::min(radius - beyond, 0.5F * glm::distance(start, end));
    return {start + inset * along, end - inset * along, radius};
}

// Across the body, as wide as hips or shoulders are, from joint to joint in height.
Capsule BodyFit::trunkByProportions(float radius) const {
    const bool lowest = body_.role == Role::hips;
    const int side = plan_.bodyOf(lowest ? Role::leftUpperLeg : Role::leftUpperArm);
    const int otherSide = plan_.bodyOf(lowest ? Role::rightUpperLeg : Role::rightUpperArm);
    float halfWidth = 0.05F * plan_.heightM;
    if (side >= 0 && otherSide >= 0) {
        const float joints = std::abs(plan_.bodies[side].start.x - plan_.bodies[otherSide].start.x);
        halfWidth = std::max((lowest ? 0.5F : 0.4F) * joints, 0.02F * plan_.heightM);
    }
    if (body_.role == Role::spine) halfWidth *= 0.7F;
    radius = std::clamp(0.5F * body_.length() + 0.01F * plan_.heightM, 0.6F * radius, radius);
    const vec3 center = 0.5F * (body_.start + body_.end);
    const vec3 across = rotation_ * vec3(1, 0, 0);
    const float half = std::max(0.0F, halfWidth - 0.3F * radius);
    return {center - half * across, center + half * across, radius};
}

}  // namespace lutka::physics
