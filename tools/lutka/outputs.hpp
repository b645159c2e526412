#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace lutka::cli {

/// Whether a file's name has that ending (".glb"), in any case.
[[nodiscard]] bool endsIn(const std::filesystem::path& file, std::string_view ending);

/// Leaves with wrong usage unless the file has one of these endings, is stdout, a pipe or a device, or has no name.
/// `option` is told. `several`: the name is that of many files, so a pipe or a device isn't taken.
void checkEnding(const char* option, const std::filesystem::path& file, const std::vector<std::string_view>& endings,
                 bool several = false);

/// Whether both are the same file, whatever way leads to it.
[[nodiscard]] bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b);

/// Leaves with wrong usage where an output is one of these inputs, which it would destroy. Nothing where it has no
/// name.
void keepInputs(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs);

}  // namespace lutka::cli
