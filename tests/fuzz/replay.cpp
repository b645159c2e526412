// Runs a target over the files and folders that are named, once each: what libFuzzer does without -max_total_time, for
// builds without it. The seeds are ordinary tests by this.

#include <cstdio>
#include <filesystem>
#include <vector>

#include "core/files.hpp"
#include "fuzz/fuzz_target.hpp"

namespace fs = std::filesystem;

namespace {

int run(const fs::path& file) {
    const auto bytes = lutka::readFile(file);
    if (!bytes) {
        std::fprintf(stderr, "%s\n", bytes.error().text().c_str());
        return 0;
    }
    static_cast<void>(LLVMFuzzerTestOneInput(bytes.value().data(), bytes.value().size()));
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    int ran = 0;
    for (int i = 1; i < argc; ++i) {
        if (!fs::is_directory(argv[i])) {
            ran += run(argv[i]);
            continue;
        }
        for (const auto& entry : fs::directory_iterator(argv[i]))
            ran += run(entry.path());
    }
    std::printf("%d inputs\n", ran);
    return ran > 0 ? 0 : 1;
}
