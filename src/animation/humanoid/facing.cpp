#include "animation/humanoid/facing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace lutka::animation {
namespace {

// Log-odds that left and right in the names are right: of 32 rigs with sides in their names two have them swapped.
// Names that agree on every joint of both limbs, and say its part besides, weigh more than any one measure of shape,
// and less than several together: conversions that mirrored the mesh and kept the names do exist.
constexpr float kNames = 2.6F;
constexpr float kNamesOfEveryLimb = 4.8F;
constexpr float kNamesOfBlocks = 3.6F;
constexpr float kFewestOfEveryLimb = 4.0F;  // pairs of joints that say their part
// What hats and hair can mislead (the head's reach, where its skin is finer) says no more than this together.
constexpr float kMostOfHead = 3.0F;
constexpr float kVerticesOfFace = 100.0F;  // of a head whose finer side proves something
constexpr float kPriorPlusZ = 0.6F;
constexpr float kMostSlope = radians(50.0F);  // of a shin that stands; those of a kneeling figure lie
constexpr float kLeastTipSlope = 0.4F;        // of a foot from its ankle: ahead for each length that it drops

class FacingFinder {
  public:
    FacingFinder(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms,
                 const TrunkCandidate& trunk)
        : framed_(framed), rig_(*framed.rig), legs_(legs), arms_(arms), trunk_(trunk) {}

    Facing find() {
        readFeet();
        readBends();
        readHead();
        readHands();
        readBack();
        facing_.shape += std::clamp(headOutline_, -kMostOfHead, kMostOfHead);
        readNames();
        facing_.prior = kPriorPlusZ * framed_.stance.through().z;
        return facing_;
    }

  private:
    [[nodiscard]] const JointPair& pair(int index) const { return framed_.pairs[index]; }

    // Adds the log-odds `slope` × value, no more than `most` either way.
    void speak(float value, float slope, float most, const char* what) {
        const float odds = std::clamp(value * slope, -most, most);
        facing_.shape += odds;
        note(odds, what);
    }

    // As speak(), of the outline of the head's skin.
    void speakOfHead(float value, float slope, float most, const char* what) {
        const float odds = std::clamp(value * slope, -most, most);
        headOutline_ += odds;
        note(odds, what);
    }

    void note(float odds, const char* what) {
        if (std::abs(odds) <= loudest_) return;
        loudest_ = std::abs(odds);
        facing_.reason = what;
    }

    void readFeet() {
        const auto& [upper, lower, foot, toes] = legs_.pairs;
        if (foot == kNoPair) {
            // A leg of one joint goes straight down from it, as blocks do, and tells nothing in the splits; a shin may
            // slope.
            if (lower != kNoPair) {
                readFootlessSoles(lower);
            } else if (!goesAside(upper)) {
                readSoles(upper);
            }
            return;
        }
        const float ankle = pair(foot).position.z;
        if (lower != kNoPair && std::abs(slopeOf(lower, foot)) > kMostSlope) {
            // Feet of a kneeling figure lie behind it, soles up: they point to the front as seen from the shin.
            if (toes != kNoPair) {
                const float ahead = fromUpright(lower, foot, pair(toes).position - pair(foot).position).z;
                speak(ahead / legs_.length, 40.0F, 5.0F, "the toes point that way");
            }
            return;
        }
        if (toes != kNoPair) {
            speak((pair(toes).position.z - ankle) / legs_.length, 40.0F, 5.0F, "the toes point that way");
        } else {
            readTips(foot, ankle);
        }
        readSoles(foot);
    }

    // Whether the middle of its skin lies more than 30 degrees to the side of the way down from the joint.
    [[nodiscard]] bool goesAside(int pairIndex) const {
        constexpr float kMostAside = 0.577F;
        const int joint = pair(pairIndex).joints[0];
        if (framed_.subtreeSkin[joint].count == 0) return false;
        const vec3 down = framed_.subtreeSkin[joint].mean() - framed_.positions[joint];
        return std::abs(down.x) > kMostAside * std::abs(down.y) + 0.1F * legs_.length;
    }

    // Angle of the shin to straight down, in the plane of symmetry; above 0 where the foot lies ahead of the knee.
    [[nodiscard]] float slopeOf(int lower, int foot) const {
        const vec3 shin = pair(foot).position - pair(lower).position;
        return std::atan2(shin.z, -shin.y);
    }

    // A direction of the foot as it would be if the shin stood upright.
    [[nodiscard]] vec3 fromUpright(int lower, int foot, const vec3& direction) const {
        const float angle = slopeOf(lower, foot);
        const float c = std::cos(angle);
        const float s = std::sin(angle);
        return {direction.x, c * direction.y - s * direction.z, s * direction.y + c * direction.z};
    }

    // Joints below an ankle without toes: tips of the foot. One that lies nearly straight below is the end of a shin
    // that is called foot, and tells only how that slopes.
    void readTips(int foot, float ankle) {
        float sum = 0.0F;
        int count = 0;
        for (const int top : pair(foot).joints) {
            for (int joint = 0; joint < rig_.count(); ++joint) {
                if (joint == top || !rig_.isAncestorOrSelf(top, joint)) continue;
                const vec3 tip = framed_.positions[joint] - framed_.positions[top];
                if (std::abs(tip.z) < kLeastTipSlope * -tip.y) continue;
                sum += framed_.positions[joint].z - ankle;
                ++count;
            }
        }
        if (count > 0)
            speak(sum / static_cast<float>(count) / legs_.length, 25.0F, 3.0F, "the feet's ends lie that way");
    }

    // The skin below the joint between two heights above its lowest point, as shares of `scale`.
    [[nodiscard]] Box skinBetween(int joint, float low, float high, float scale) const {
        Box band;
        const float floor = framed_.subtreeSkin[joint].low.y;
        for (const RigFeatures::Vertex& vertex : rig_.vertices) {
            if (!rig_.isAncestorOrSelf(joint, vertex.joint)) continue;
            const float y = glm::dot(vertex.position, framed_.stance.up);
            if (y < floor + low * scale || y >= floor + high * scale) continue;
            band.add(vec3(0, y, glm::dot(vertex.position, framed_.stance.through())));
        }
        return band;
    }

    // Of the skin's height below the joint, but of no more than a share of the leg: a foot's.
    [[nodiscard]] float footHeight(int joint) const {
        const Box& whole = framed_.subtreeSkin[joint];
        return std::min(whole.high.y - whole.low.y, 0.3F * legs_.length);
    }

    static float middle(const Box& band) { return 0.5F * (band.low.z + band.high.z); }

    // The lowest skin of the leg reaches farther to the front of the ankle than to its back.
    void readSoles(int pairIndex) {
        for (const int joint : pair(pairIndex).joints) {
            if (framed_.subtreeSkin[joint].count == 0) continue;
            const Box sole = skinBetween(joint, 0.0F, 0.35F, footHeight(joint));
            if (sole.count == 0) continue;
            const float reach = middle(sole) - framed_.positions[joint].z;
            speak(reach / legs_.length, 20.0F, 2.0F, "the soles reach that way");
        }
    }

    // Where no joint marks the ankle, the skin above the sole does: the knee tells only how the shin slopes.
    void readFootlessSoles(int pairIndex) {
        for (const int joint : pair(pairIndex).joints) {
            if (framed_.subtreeSkin[joint].count == 0) continue;
            const Box sole = skinBetween(joint, 0.0F, 0.35F, footHeight(joint));
            const Box ankle = skinBetween(joint, 0.5F, 1.0F, footHeight(joint));
            if (sole.count == 0 || ankle.count == 0) continue;
            speak((middle(sole) - middle(ankle)) / legs_.length, 20.0F, 2.0F, "the soles reach that way");
        }
    }

    // Knees stand in front of the line from hip to ankle, elbows behind that from shoulder to wrist.
    void readBends() {
        const auto bend = [&](const LimbCandidate& limb) {
            const vec3 along = limb.tip - limb.root;
            const vec3 middle = pair(limb.pairs[1]).position - limb.root;
            const float share = glm::dot(middle, along) / (glm::dot(along, along) + 1e-9F);
            return (middle.z - share * along.z) / limb.length;
        };
        if (legs_.jointCount() == 3) speak(bend(legs_), 40.0F, 1.5F, "the knees bend that way");
        if (arms_.jointCount() == 3) speak(-bend(arms_), 25.0F, 1.0F, "the elbows bend that way");
    }

    void readHead() {
        if (trunk_.head == kNoJoint) return;
        const float neck = framed_.positions[trunk_.head].z;
        const Box& skin = framed_.subtreeSkin[trunk_.head];
        const float size = std::max(skin.count > 0 ? skin.high.y - skin.low.y : 0.0F, 0.02F * framed_.spread);
        float face = 0.0F;
        int count = 0;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (joint == trunk_.head || !rig_.isAncestorOrSelf(trunk_.head, joint)) continue;
            if (!rig_.names[joint].face || std::abs(framed_.positions[joint].x) > 0.35F * size) continue;
            face += framed_.positions[joint].z - neck;
            ++count;
        }
        if (count > 0) speak(face / static_cast<float>(count) / size, 12.0F, 2.5F, "the face's joints lie that way");
        const Box& own = framed_.ownSkin[trunk_.head];
        if (own.count == 0) return;
        speakOfHead((0.5F * (own.low.z + own.high.z) - neck) / size, 5.0F, 1.2F, "the head reaches that way");
        // Eyes, nose and mouth take more vertices than the back of the head; a box has none.
        const float detail = std::min(static_cast<float>(own.count) / kVerticesOfFace, 1.0F);
        speakOfHead((own.mean().z - 0.5F * (own.low.z + own.high.z)) / size, 28.0F * detail, 3.0F * detail,
                    "the head is finer on that side");
    }

    // Capes, packs and wings hang behind the trunk.
    void readBack() {
        const float trunk = framed_.positions[trunk_.chest].z;
        const float size = std::max(arms_.root.y - legs_.root.y, 0.05F * framed_.spread);
        float behind = 0.0F;
        int count = 0;
        for (int joint = 0; joint < rig_.count(); ++joint) {
            if (!rig_.names[joint].onBack) continue;
            const Box& skin = framed_.ownSkin[joint];
            behind += trunk - (skin.count > 0 ? middle(skin) : framed_.positions[joint].z);
            ++count;
        }
        if (count > 0) speak(behind / static_cast<float>(count) / size, 14.0F, 3.5F, "what hangs on the back says so");
    }

    void readHands() {
        if (arms_.pairs[2] == kNoPair) return;
        for (const int hand : pair(arms_.pairs[2]).joints) {
            for (const int finger : rig_.children[hand]) {
                if (!rig_.names[finger].thumb) continue;
                const float forward = framed_.positions[finger].z - framed_.positions[hand].z;
                speak(forward / arms_.length, 15.0F, 0.7F, "the thumbs point that way");
            }
        }
    }

    void readNames() {
        float agree = 0.0F;
        float counted = 0.0F;
        bool sayParts = true;
        float said = 0.0F;
        for (const LimbCandidate* limb : {&legs_, &arms_}) {
            const float others = agree;
            for (std::size_t slot = 0; slot < limb->pairs.size(); ++slot) {
                const int index = limb->pairs[slot];
                if (index == kNoPair) continue;
                const Side plus = rig_.names[pair(index).joints[0]].side;
                const Side minus = rig_.names[pair(index).joints[1]].side;
                if (plus == minus) continue;
                counted += 1.0F;
                const bool says = pair(index).names[partsOf(limb->kind)[slot]] > 0.0F;
                said += says ? 1.0F : 0.0F;
                sayParts = sayParts && says;
                agree += plus == Side::left || minus == Side::right ? 1.0F : -1.0F;
            }
            facing_.namesSplit = others * (agree - others) < 0.0F;
        }
        const bool ofBlocks = legs_.jointCount() == 1 && arms_.jointCount() == 1 && counted >= 2.0F;
        const bool agrees = std::abs(agree) >= counted;
        const float weight = agrees && said >= kFewestOfEveryLimb ? kNamesOfEveryLimb
                             : agrees && sayParts && ofBlocks     ? kNamesOfBlocks
                                                                  : kNames;
        if (counted > 0.0F) facing_.names = weight * agree / counted;
        facing_.shapeReason = facing_.reason;
        if (std::abs(facing_.names) > loudest_ + 1.0F) facing_.reason = "left and right in the names say so";
    }

    const FramedRig& framed_;
    const RigFeatures& rig_;
    const LimbCandidate& legs_;
    const LimbCandidate& arms_;
    const TrunkCandidate& trunk_;
    Facing facing_;
    float loudest_ = 0.0F;
    float headOutline_ = 0.0F;
};

}  // namespace

Facing findFacing(const FramedRig& framed, const LimbCandidate& legs, const LimbCandidate& arms,
                  const TrunkCandidate& trunk) {
    return FacingFinder(framed, legs, arms, trunk).find();
}

}  // namespace lutka::animation
