#include "animation/import/fbx/read_fbx.hpp"
#include "fuzz/fuzz_target.hpp"
#include "model_file.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const fuzz::ModelFile file(data, size);
    fuzz::promiseSoundImport(animation::rig_import::readFbx(file.path(), {}));
    return 0;
}
