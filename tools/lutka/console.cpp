#include "console.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "core/utf8.hpp"

namespace lutka::cli {

void printClean(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string line = withoutControls(wellFormedUtf8(text.substr(at, end - at), "?"), ' ');
        fmt::print("{}{}", line, end < text.size() ? "\n" : "");
        at = end + 1;
    }
}

bool isQuiet() {
    return !spdlog::should_log(spdlog::level::warn);
}

Stopwatch::Stopwatch(std::string what) : what_(std::move(what)), begun_(std::chrono::steady_clock::now()) {}

Stopwatch::~Stopwatch() {
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun_;
    spdlog::debug("{}: {:.2f} s", what_, taken.count());
}

Progress::Progress(std::string what, int total)
    : what_(std::move(what)),
      total_(std::max(total, 1)),
      terminal_(::isatty(STDERR_FILENO) == 1 && !isQuiet()),
      begun_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
    if (terminal_) fmt::print(stderr, "\r\033[K");
}

void Progress::at(int done) {
    using namespace std::chrono_literals;
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - drawn_ < 100ms && done < total_) return;
    drawn_ = now;
    constexpr int width = 30;
    const int filled = width * done / total_;
    // A guess of the first second would jump about.
    const std::chrono::duration<double> taken = now - begun_;
    std::string left;
    if (taken > 1s && done > 0) left = fmt::format(", {:.0f} s left", taken.count() * (total_ - done) / done);
    fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {}/{}{}", what_, "", filled, "", width - filled, done, total_,
               left);
    std::fflush(stderr);
}

void printWarnings(const animation::Character& character) {
    for (const std::string& warning : character.warnings)
        spdlog::warn("{}: {}", character.file.string(), warning);
}

void printWarnings(const animation::HumanoidMap& map) {
    for (const std::string& warning : map.warnings)
        spdlog::warn("{}", warning);
}

void printWarnings(const scene::RagdollAsset& asset) {
    printWarnings(asset.character);
    printWarnings(asset.map);
    if (asset.fromModel)
        spdlog::warn("{}: the ragdoll is the file's own; --refit fits a new one", asset.character.file.string());
    if (asset.rebound)
        spdlog::warn("{}: the profile was made for another rig and is bound by role", asset.character.file.string());
}

}  // namespace lutka::cli
