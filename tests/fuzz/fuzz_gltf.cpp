#include "animation/import/gltf/read_gltf.hpp"
#include "fuzz/fuzz_target.hpp"
#include "model_file.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::ModelFile file(data, size);
    fuzz::promiseSoundImport(animation::rig_import::readGltf(file.path(), {}));
    return 0;
}
