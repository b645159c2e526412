#include "animation/retarget/retarget_figures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "animation/retarget/foot_keeper.hpp"

namespace lutka::animation {
namespace {

double degreesBetween(const vec3& a, const vec3& b) {
    const float sine = glm::length(glm::cross(a, b));
    return static_cast<double>(degrees(std::atan2(sine, glm::dot(a, b))));
}

vec3 between(const AnatomicalRig& rig, std::span<const RigidTransform> pose, Role a, Role b) {
    return (pose[rig.jointOf(a)].translation + pose[rig.jointOf(b)].translation) * 0.5F;
}

// An axis of a role's anatomical frame, in the pose's space.
vec3 axisOf(const AnatomicalRig& rig, std::span<const RigidTransform> pose, Role role, const vec3& axis) {
    return pose[rig.jointOf(role)].rotation * (rig.jointFromAnatomy[indexOf(role)] * axis);
}

constexpr std::array kLimbs{Role::leftUpperArm,  Role::leftLowerArm,  Role::leftUpperLeg,  Role::leftLowerLeg,
                            Role::rightUpperArm, Role::rightLowerArm, Role::rightUpperLeg, Role::rightLowerLeg};
constexpr std::array kFeet{Role::leftFoot, Role::rightFoot};

}  // namespace

double RetargetFigures::meanLimbDeg() const {
    double sum = 0.0;
    int count = 0;
    for (const DirectionError& error : directions) {
        if (!error.limb) continue;
        sum += error.degrees.mean;
        ++count;
    }
    return count > 0 ? sum / count : 0.0;
}

double RetargetFigures::mostLimbDeg() const {
    double most = 0.0;
    for (const DirectionError& error : directions) {
        if (error.limb) most = std::max(most, error.degrees.most);
    }
    return most;
}

void RetargetMeter::Sum::add(double value) {
    sum += value;
    most = std::max(most, value);
    ++count;
}

MeanAndMost RetargetMeter::Sum::result() const {
    return {count > 0 ? sum / count : 0.0, most};
}

RetargetMeter::RetargetMeter(const Retargeter& retargeter, const std::array<FootContact, 2>& contacts,
                             float sourceFloor)
    : retargeter_(retargeter), contacts_(contacts), sourceFloor_(sourceFloor) {
    for (const Role role : kLimbs)
        parts_.push_back({std::string(roleName(role)), true, {}});
    for (const Role role : kFeet)
        parts_.push_back({std::string(roleName(role)), true, {}});
    for (const char* name : {"trunk", "neck", "face"})
        parts_.push_back({name, false, {}});
}

// Each part has its place in parts_, also where there is nothing to compare.
void RetargetMeter::addDirections() {
    std::size_t part = 0;
    const auto note = [&](const std::optional<double>& degrees) {
        if (degrees) parts_[part].degrees.add(*degrees);
        ++part;
    };
    for (const Role role : kLimbs)
        note(limbOff(role));
    for (const Role role : kFeet)
        note(footOff(role));
    note(trunkOff());
    note(neckOff());
    note(axisOff(Role::head, {0, 0, 1}));
}

std::optional<double> RetargetMeter::limbOff(Role role) const {
    const AnatomicalRig& from = retargeter_.source();
    const AnatomicalRig& to = retargeter_.target();
    const bool ofLeg = isEitherSide(role, Role::leftUpperLeg) || isEitherSide(role, Role::leftLowerLeg);
    if (ofLeg && !(from.hasLegs() && to.hasLegs())) return std::nullopt;
    Role end = *endOfBone(role);
    // Of a limb without a middle the whole way is compared, once.
    const bool isStiff = std::any_of(to.stiffLimbs.begin(), to.stiffLimbs.end(), [&](const StiffLimb& limb) {
        return to.jointOf(role) == limb.upper || to.jointOf(role) == limb.middle;
    });
    if (isStiff) {
        if (to.isAdded(role)) return std::nullopt;
        end = *endOfBone(end);
    }
    const auto isWhole = [&](const AnatomicalRig& rig) { return rig.has(role) && rig.has(end); };
    if (!isWhole(from) || !isWhole(to)) return std::nullopt;
    const auto way = [&](const AnatomicalRig& rig, std::span<const RigidTransform> pose) {
        return pose[rig.jointOf(end)].translation - pose[rig.jointOf(role)].translation;
    };
    return degreesBetween(way(from, retargeter_.sourcePose()), way(to, retargeter_.targetPose()));
}

std::optional<double> RetargetMeter::footOff(Role role) const {
    if (retargeter_.target().isAdded(role) || retargeter_.source().isAdded(role)) return std::nullopt;
    return axisOff(role, {1, 0, 0});
}

double RetargetMeter::trunkOff() const {
    const auto trunk = [](const AnatomicalRig& rig, std::span<const RigidTransform> pose) {
        return pose[rig.neckOrHead()].translation - between(rig, pose, Role::leftUpperLeg, Role::rightUpperLeg);
    };
    return degreesBetween(trunk(retargeter_.source(), retargeter_.sourcePose()),
                          trunk(retargeter_.target(), retargeter_.targetPose()));
}

std::optional<double> RetargetMeter::neckOff() const {
    if (!retargeter_.source().has(Role::neck) || !retargeter_.target().has(Role::neck)) return std::nullopt;
    const auto neck = [](const AnatomicalRig& rig, std::span<const RigidTransform> pose) {
        return pose[rig.jointOf(Role::head)].translation - pose[rig.neckOrHead()].translation;
    };
    return degreesBetween(neck(retargeter_.source(), retargeter_.sourcePose()),
                          neck(retargeter_.target(), retargeter_.targetPose()));
}

double RetargetMeter::axisOff(Role role, const vec3& axis) const {
    return degreesBetween(axisOf(retargeter_.source(), retargeter_.sourcePose(), role, axis),
                          axisOf(retargeter_.target(), retargeter_.targetPose(), role, axis));
}

bool RetargetMeter::stands(std::size_t side, std::size_t point, int frame) const {
    const std::vector<bool>& flags = point == 0 ? contacts_[side].heel : contacts_[side].ball;
    return frame >= 0 && frame < static_cast<int>(flags.size()) && flags[frame];
}

void RetargetMeter::addFeet(const AnatomicalRig& rig, std::span<const RigidTransform> pose, float floor, float toCm,
                            Feet& feet) {
    for (std::size_t side = 0; side < 2; ++side) {
        const AnatomicalRig::Foot& foot = rig.feet[side];
        const std::array points{pose[foot.joint].translation, foot.ballIn(pose)};
        const vec3 up = pose[foot.joint].rotation * foot.upInJoint;
        feet.depth.add(static_cast<double>(std::max(depthOf(foot, points[0], points[1], up, floor), 0.0F) * toCm));
        for (std::size_t point = 0; point < points.size(); ++point) {
            // While the ball stands the heel may roll.
            const auto counts = [&](int frame) {
                return stands(side, point, frame) && (point == 1 || !stands(side, 1, frame));
            };
            if (!counts(frame_)) continue;
            if (!counts(frame_ - 1)) {
                feet.began[side][point] = points[point];
                feet.strayed[side][point] = 0.0F;
            }
            vec3 way = points[point] - feet.began[side][point];
            way.y = 0.0F;
            feet.strayed[side][point] = std::max(feet.strayed[side][point], glm::length(way));
            if (!counts(frame_ + 1)) feet.slide.add(static_cast<double>(feet.strayed[side][point] * toCm));
        }
    }
}

void RetargetMeter::add() {
    constexpr float kCm = 100.0F;
    addDirections();
    if (retargeter_.source().hasLegs() && retargeter_.target().hasLegs()) {
        addFeet(retargeter_.source(), retargeter_.sourcePose(), sourceFloor_, retargeter_.scale() * kCm, source_);
        addFeet(retargeter_.target(), retargeter_.targetPose(), retargeter_.target().floor, kCm, target_);
    }
    ++frame_;
}

RetargetFigures RetargetMeter::result() const {
    RetargetFigures figures;
    for (const Part& part : parts_) {
        if (part.degrees.count > 0) figures.directions.push_back({part.name, part.limb, part.degrees.result()});
    }
    figures.slideCm = target_.slide.result();
    figures.sourceSlideCm = source_.slide.result();
    figures.penetrationCm = target_.depth.result();
    figures.sourcePenetrationCm = source_.depth.result();
    figures.contacts = target_.slide.count;
    figures.scale = retargeter_.scale();
    return figures;
}

}  // namespace lutka::animation
