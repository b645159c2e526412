#include "animation/segments/segment_rig.hpp"

#include <algorithm>

#include "animation/humanoid/crowds.hpp"
#include "animation/segments/clip_hinges.hpp"
#include "animation/segments/segment_sides.hpp"
#include "animation/segments/segment_tree.hpp"
#include "core/assert.hpp"

namespace lutka::animation {
namespace {

// For a creature, the skin says which joints count. Joints with a man's names may move none of it: the skin of those
// limbs then follows other joints.
RigFeatures readCreature(const Character& character) {
    RigFeatures rig = readRig(character, true);
    rig.skinned = rig.skinned || rig.partlySkinned;
    rig.partlySkinned = false;
    return rig;
}

SegmentedRig segmentsOfWhole(const Character& character, const SegmentOptions& options) {
    constexpr float kFirstShortest = 0.04F;  // of the longest extent
    constexpr float kCoarser = 1.2F;
    SegmentedRig result;
    const RigFeatures rig = readCreature(character);
    const RigMeasures measures = measureRig(rig);
    float shortest = kFirstShortest * measures.size;
    const auto most = static_cast<std::size_t>(options.mostSegments);
    // Nothing is longer than the whole, so that this ends with one segment at the latest.
    for (result.segments = segmentTree(rig, measures, character.skeleton.names, shortest);
         result.segments.size() > most;
         result.segments = segmentTree(rig, measures, character.skeleton.names, shortest)) {
        shortest *= kCoarser;
    }
    result.standardFromModel = findSides(rig, measures.size, result.segments);
    orderSegments(result.segments);
    return result;
}

// The crowds of things beside a creature are no bodies of it, and time would grow with their square.
SegmentedRig segmentsOf(const Character& character, const SegmentOptions& options) {
    const auto few = leaveOutCrowds(character, {});
    if (!few || few->character.skeleton.jointCount() == 0) return segmentsOfWhole(character, options);
    SegmentedRig result = segmentsOfWhole(few->character, options);
    for (Segment& segment : result.segments) {
        segment.joint = few->originalOf(segment.joint);
        segment.end = few->originalOf(segment.end);
    }
    return result;
}

}  // namespace

SegmentedRig segmentRig(const Character& character, const SegmentOptions& options) {
    constexpr int kMost = 256;
    LUTKA_ASSERT(options.mostSegments >= 1 && options.mostSegments <= kMost);
    if (character.skeleton.jointCount() == 0) return {};
    SegmentedRig result = segmentsOf(character, options);
    findClipHinges(character, result.standardFromModel, result.segments);
    return result;
}

}  // namespace lutka::animation
