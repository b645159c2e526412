#include "animation/import/scene_blob.hpp"
#include "fuzz/fuzz_target.hpp"

using namespace lutka;
namespace rig_import = lutka::animation::rig_import;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto scene = rig_import::unpackScene(fuzz::textOf(data, size), "fuzz");
    if (!scene) return 0;
    fuzz::promise(rig_import::problemOf(scene.value()).empty());
    fuzz::promise(rig_import::packScene(scene.value()).size() <= size);
    return 0;
}
