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

// Ends by running out of stack, not by `depth`; the compiler must not see that.
int descend(const volatile int& most, int depth) {
    volatile char frame[4096];
    frame[depth % 4096] = static_cast<char>(depth);
    if (depth >= most) return frame[depth % 4096];
    return descend(most, depth + 1) + frame[depth % 4096];
}

Result<SourceScene> behave(const std::filesystem::path& file, const ImportOptions& options) {
    std::string text;
    std::getline(std::ifstream(file), text);
    SourceScene scene;
    scene.format = options.loadTextures ? "with pictures" : "without pictures";
    scene.nodes.resize(1);
    scene.nodes[0].name = "root";
    if (text == "crash") std::raise(SIGSEGV);
    for (volatile bool on = true; on && text == "hang";) {
    }
    if (text == "deep") {
        const volatile int endless = 2'000'000'000;
        scene.format = std::to_string(descend(endless, 0));
    }
    std::vector<std::vector<char>> bomb;
    while (text == "bomb")
        bomb.emplace_back(std::size_t{64} << 20U, 'x');
    if (text == "print" || text == "print and crash") {
        std::puts("a third party's chatter");
        std::fputs(
            "in \x1b[31mcolour\xff \xc2\x9b"
            "31m\n\n",
            stderr);
        std::fflush(stdout);
    }
    if (text == "print and crash") std::raise(SIGSEGV);
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
