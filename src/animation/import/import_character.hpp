#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "animation/character.hpp"
#include "core/result.hpp"

namespace lutka::animation {

/// The direction of the file's data that points up.
enum class UpAxis { positiveX, negativeX, positiveY, negativeY, positiveZ, negativeZ };

/// A process of its own that reads the file, so that one that crashes, hangs or exhausts memory over it is an error
/// like any other. Without a program the file is read in this process.
struct ImportWorker {
    std::filesystem::path program;  ///< Calls serveImport() with its arguments when asksForImport() of the first one.
    std::size_t memoryBytes = std::size_t{3} << 29U;  ///< Address space: 1.5 GiB.
    int seconds = 20;                                 ///< Of processor time, and of time on the wall.
    std::function<bool()> stop;                       ///< Asked ten times a second; true gives the reading up.
    /// Told each line that readers print there, fit for a terminal; unset: to standard error.
    std::function<void(const std::string& line)> printed;
};

struct ImportOptions {
    /// Metres a file unit, > 0 (else ErrorCode::usage); unset: from the file's metadata, or from the figure's height
    /// where that is missing or absurd.
    std::optional<float> metresPerFileUnit;
    std::optional<UpAxis> up;  ///< Unset: from the file's metadata, or from the figure where that is missing.
    /// Which of Character::figures is taken, counted from 1; unset: the one with most vertices. One that is not there
    /// is ErrorCode::usage.
    std::optional<int> figure;
    bool loadTextures = true;  ///< False skips decoding pictures (mapping and physics don't need them).
    /// Pictures, buffers and material libraries may lie anywhere. False: only in the model's folder and below, where
    /// links lead too; a buffer elsewhere is an error, the rest is left out with a warning.
    bool allowOutside = false;
    ImportWorker worker;
    /// Without a worker: what readers print to standard output goes to standard error (StdoutAside: the whole process's
    /// does meanwhile).
    bool stdoutAside = false;
};

/// Loads any rigged model that Assimp reads and settles it in model space: metres, Y up, rigid joint frames with all
/// scales baked, vertices in the bind pose, at most four influences with sum 1. Which way it faces is left as it is.
/// Fails with ErrorCode::input (file, reason, mend); never throws.
[[nodiscard]] Result<Character> importCharacter(const std::filesystem::path& file, const ImportOptions& options = {});

/// For the worker's main(): whether its first argument asks for an import, and the import itself, which takes from the
/// process all but reading. `arguments` are all but the program's name. Returns the process's exit code.
[[nodiscard]] bool asksForImport(const std::string& argument);
[[nodiscard]] int serveImport(const std::vector<std::string>& arguments);

}  // namespace lutka::animation
