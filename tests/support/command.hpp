#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "support/skip.hpp"

namespace lutka::test {

inline std::string fileText(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// A folder of its own, removed at the end.
struct ScratchFolder {
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "lutka_test_XXXXXX").string();
        path = ::mkdtemp(name.data());
    }
    ~ScratchFolder() { std::filesystem::remove_all(path); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] std::string operator/(const std::string& name) const { return (path / name).string(); }

    std::filesystem::path path;
};

/// How many entries a folder has.
inline std::ptrdiff_t filesIn(const std::filesystem::path& folder) {
    return std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator());
}

struct CommandResult {
    int code = -1;  ///< Exit code; -1 when it was ended by a signal.
    std::string out;
    std::string err;
};

/// Runs a shell command line without a display and collects what it prints.
inline CommandResult runCommand(const std::string& line) {
    const ScratchFolder folder;
    const std::string out = folder / "out";
    const std::string err = folder / "err";
    const int status =
        std::system(("env -u DISPLAY -u WAYLAND_DISPLAY " + line + " >" + out + " 2>" + err + " </dev/null").c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, fileText(out), fileText(err)};
}

/// Runs the shipped binary.
inline CommandResult lutkaCommand(const std::string& arguments) {
    return runCommand("'" LUTKA_BINARY "' " + arguments);
}

inline std::string shellQuoted(const std::filesystem::path& file) {
    return "'" + file.string() + "'";
}

/// Our own character, as a word of a command line.
inline const std::string kMannequinArgument = shellQuoted(LUTKA_ASSETS_DIR "/models/mannequin.glb");

/// Exit code of a command that needs a display or a GL context and has none.
inline constexpr int kNoDisplay = 6;

}  // namespace lutka::test

/// Skips the test case where the program is not on the PATH.
#define NEEDS_PROGRAM(name) \
    if (runCommand("sh -c 'command -v " name "'").code != 0) SKIP_TEST("the program " name " is not on the PATH")

/// Skips the test case where the command ended for want of a display or a GL context.
#define NEEDS_DISPLAY_OF(result) \
    if ((result).code == lutka::test::kNoDisplay) SKIP_TEST("no headless OpenGL context")
