#include "fuzz/fuzz_target.hpp"
#include "scene/run/recording.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto recording = scene::recordingFromBytes(std::span(data, size), "fuzz");
    if (!recording) return 0;
    for (int step = 0; step < recording.value().steps(); ++step) {
        for (const RigidTransform& frame : recording.value().frame(step))
            fuzz::promise(isFinite(frame));
    }
    return 0;
}
