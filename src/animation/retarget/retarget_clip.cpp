#include "animation/retarget/retarget_clip.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "animation/retarget/foot_keeper.hpp"

namespace lutka::animation {
namespace {

Result<void> checkSourceClip(const Clip& clip, std::size_t joints) {
    const auto refuse = [&](const char* what) {
        return Error{ErrorCode::input, fmt::format("clip '{}' {}", clip.name, what), "", "take a clip of the source"};
    };
    if (clip.frameCount < 1 || !(clip.framesPerSecond > 0.0F)) return refuse("has no frames");
    if (clip.parentFromJoint.size() != joints * static_cast<std::size_t>(clip.frameCount))
        return refuse("is none of this skeleton");
    const auto& frames = clip.parentFromJoint.get();
    if (!std::all_of(frames.begin(), frames.end(), [](const RigidTransform& frame) { return isFinite(frame); }))
        return refuse("has a frame that is not finite");
    return {};
}

void addTo(FootTrack& track, const AnatomicalRig::Foot& foot, std::span<const RigidTransform> pose) {
    track.ankle.push_back(pose[foot.joint].translation);
    track.ball.push_back(foot.ballIn(pose));
}

/// One clip on its way over.
class Crossing {
  public:
    Crossing(Retargeter& retargeter, const Clip& clip)
        : retargeter_(retargeter), clip_(clip), pose_(static_cast<std::size_t>(retargeter.target().fileJoints)) {}

    // Without keeping the feet: what they do in both figures.
    void look() {
        watch();
        setFloor(floorOfMotion(retargeter_.source(), source_));
    }

    // Hips that are wide for the legs turn less.
    void turnHips() {
        const float width = widthOf(retargeter_.target());
        const float excess = width > 0.0F ? 1.0F - widthOf(retargeter_.source()) * retargeter_.scale() / width : 0.0F;
        if (excess <= 0.0F) return;
        turns_ = hipsTurns(retargeter_.target(), motion_, contacts_, excess, clip_.framesPerSecond);
        watch();
    }

    void findContacts(const ContactSettings& settings) {
        const AnatomicalRig& source = retargeter_.source();
        for (std::size_t side = 0; side < 2; ++side)
            contacts_[side] = contactsOf(source.feet[side], source_[side], placement_.sourceFloor, source.legLength,
                                         clip_.framesPerSecond, settings);
        setFloor(standingHeight(source, source_, contacts_).value_or(placement_.sourceFloor));
    }

    RetargetedClip take(bool keep) {
        RetargetedClip out;
        out.clip.name = clip_.name;
        out.clip.framesPerSecond = clip_.framesPerSecond;
        out.clip.frameCount = clip_.frameCount;
        std::vector<FootShift> shifts(static_cast<std::size_t>(clip_.frameCount));
        // Legs without knees reach the floor at one place only, which pose() has put them to; and who has none, stands
        // on none.
        const bool haveLegs = retargeter_.source().hasLegs() && retargeter_.target().hasLegs();
        if (keep && haveLegs && !retargeter_.target().hasStiffLegs())
            shifts = keepFeet(retargeter_.target(), motion_, contacts_, clip_.framesPerSecond);
        for (std::size_t frame = 0; frame < turns_.size(); ++frame)
            shifts[frame].hipsTurn = turns_[frame];
        RetargetMeter meter(retargeter_, contacts_, placement_.sourceFloor);
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            retargeter_.pose(sourceFrame(frame), placement_, shifts[frame], pose_);
            out.clip.parentFromJoint.append(pose_);
            meter.add();
        }
        out.figures = meter.result();
        return out;
    }

  private:
    static float widthOf(const AnatomicalRig& rig) {
        return glm::distance(rig.bindOf(Role::leftUpperLeg), rig.bindOf(Role::rightUpperLeg));
    }
    // What both figures do with the feet as they are.
    void watch() {
        source_ = {};
        motion_ = {};
        const AnatomicalRig& target = retargeter_.target();
        for (int frame = 0; frame < clip_.frameCount; ++frame) {
            FootShift shift;
            if (!turns_.empty()) shift.hipsTurn = turns_[static_cast<std::size_t>(frame)];
            retargeter_.pose(sourceFrame(frame), placement_, shift, pose_);
            for (std::size_t side = 0; side < 2; ++side) {
                addTo(source_[side], retargeter_.source().feet[side], retargeter_.sourcePose());
                addTo(motion_.tracks[side], target.feet[side], retargeter_.targetPose());
                const auto of = [&](Role left) { return target.jointOf(side == 0 ? left : mirrored(left)); };
                const auto pose = retargeter_.targetPose();
                motion_.hips[side].push_back(pose[of(Role::leftUpperLeg)].translation);
                const AnatomicalRig::Foot& foot = target.feet[side];
                motion_.up[side].push_back(pose[foot.joint].rotation * foot.upInJoint);
                const vec3& knee = pose[of(Role::leftLowerLeg)].translation;
                motion_.legReach[side] = glm::distance(pose[of(Role::leftUpperLeg)].translation, knee) +
                                         glm::distance(knee, pose[foot.joint].translation);
            }
        }
    }
    // What was seen of the target is where it stands on that floor.
    void setFloor(float height) {
        const vec3 sunk(0, (height - placement_.sourceFloor) * retargeter_.scale(), 0);
        placement_.sourceFloor = height;
        for (std::size_t side = 0; side < 2; ++side) {
            for (std::vector<vec3>* points :
                 {&motion_.tracks[side].ankle, &motion_.tracks[side].ball, &motion_.hips[side]}) {
                for (vec3& point : *points)
                    point -= sunk;
            }
        }
    }
    [[nodiscard]] std::span<const RigidTransform> sourceFrame(int frame) const {
        const auto joints = static_cast<std::size_t>(retargeter_.source().fileJoints);
        return std::span(clip_.parentFromJoint.get()).subspan(static_cast<std::size_t>(frame) * joints, joints);
    }

    Retargeter& retargeter_;
    const Clip& clip_;
    std::vector<RigidTransform> pose_;
    RetargetPlacement placement_;
    std::array<FootTrack, 2> source_;
    FootMotion motion_;
    std::array<FootContact, 2> contacts_;
    std::vector<vec3> turns_;  // of the hips, one a frame; empty: none
};

}  // namespace

Result<RetargetedClip> retargetClip(Retargeter& retargeter, const Clip& clip, const RetargetOptions& options) {
    if (auto checked = checkSourceClip(clip, static_cast<std::size_t>(retargeter.source().fileJoints)); !checked)
        return checked.error();
    Crossing crossing(retargeter, clip);
    crossing.look();
    crossing.findContacts(options.contacts);
    if (options.keepFeet && !retargeter.target().hasStiffLegs()) crossing.turnHips();
    return crossing.take(options.keepFeet);
}

}  // namespace lutka::animation
