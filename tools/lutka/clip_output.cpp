#include "clip_output.hpp"

#include "animation/export/write_bvh.hpp"
#include "animation/export/write_glb.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace lutka::cli {

bool isMotionAlone(const std::filesystem::path& file) {
    return endsIn(file, ".bvh");
}

void writeClip(const std::filesystem::path& file, const animation::Character& character, const animation::Clip& clip,
               const RigidTransform& worldFromModel, bool allKeys) {
    orLeave(isMotionAlone(file) ? animation::writeBvh(file, character.skeleton, clip, worldFromModel)
                                : animation::writeGlb(file, character, std::span(&clip, 1), worldFromModel,
                                                      animation::keysKept(allKeys)));
}

}  // namespace lutka::cli
