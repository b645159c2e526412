#include "outputs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <system_error>

#include "core/files.hpp"
#include "core/letter_case.hpp"
#include "options.hpp"

namespace lutka::cli {

namespace fs = std::filesystem;

bool endsIn(const fs::path& file, std::string_view ending) {
    return sameButCase(file.extension().string(), ending);
}

void checkEnding(const char* option, const fs::path& file, const std::vector<std::string_view>& endings, bool several) {
    if (file.empty() || isStandardOutput(file)) return;
    std::error_code failed;
    if (!several && fs::is_other(fs::status(file, failed))) return;
    if (std::any_of(endings.begin(), endings.end(), [&](std::string_view ending) { return endsIn(file, ending); }))
        return;
    const std::string known = fmt::format("{}", fmt::join(endings, " or "));
    leave({ErrorCode::usage, fmt::format("'{}' doesn't end in {}", file.string(), known), option,
           fmt::format("this output is always {}: name it so", known)});
}

bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code failed;
    return fs::weakly_canonical(a, failed) == fs::weakly_canonical(b, failed);
}

void keepInputs(const fs::path& output, const std::vector<fs::path>& inputs) {
    if (output.empty()) return;
    for (const fs::path& input : inputs) {
        if (input.empty() || !isSameFile(output, input)) continue;
        leave({ErrorCode::usage, "is named twice: an output would destroy it", output.string(),
               "give every input and output a name of its own"});
    }
}

}  // namespace lutka::cli
