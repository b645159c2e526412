#include "fuzz/fuzz_target.hpp"
#include "scene/description/scene_file.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto scene = scene::sceneFromJson(fuzz::textOf(data, size), "fuzz", "/folder");
    if (!scene) return 0;
    const auto again = scene::sceneFromJson(scene::sceneToJson(scene.value(), "/folder"), "again", "/folder");
    fuzz::promise(again.ok());
    return 0;
}
