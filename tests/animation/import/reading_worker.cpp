// A program that serves readings with a reader that does what the file's text says: what hostile files do to a real
// one.

#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "animation/import/isolated_reading.hpp"

using namespace lutka;
using namespace lutka::animation;
using namespace lutka::animation::rig_import;

namespace {

int descend(volatile int* above, int depth) {
    volatile char frame[4096];
    frame[depth % 4096] = static_cast<char>(*above);
    volatile int here = frame[depth % 4096];
    return descend(&here, depth + 1) + here;
}

Result<SourceScene> behave(const std::filesystem::path& file, const ImportOptions& options) {
    std::string text;
    std::getline(std::ifstream(file), text);
    SourceScene scene;
    scene.format = options.loadTextures ? "with pictures" : "without pictures";
    scene.nodes.resize(1);
    scene.nodes[0].name = "root";
    if (text == "crash") std::raise(SIGSEGV);
    for (volatile int i = 0; text == "hang"; i = i + 1) {
    }
    if (text == "deep") {
        volatile int start = 0;
        descend(&start, 0);
    }
    std::vector<std::vector<char>> bomb;
    while (text == "bomb")
        bomb.emplace_back(std::size_t{64} << 20U, 'x');
    if (text == "print") std::puts("a third party's chatter");
    if (text == "write" && std::ofstream(file.string() + ".out")) scene.format = "wrote";
    if (text == "throw") throw std::runtime_error("thrown");
    if (text == "error") return Error{ErrorCode::input, "is not to my taste", file.string(), "cook again"};
    if (text == "wrong") scene.nodes[0].parent = 7;
    return scene;
}

}  // namespace

int main(int argc, char** argv) {
    return serveReading(std::vector<std::string>(argv + 1, argv + argc), behave);
}
