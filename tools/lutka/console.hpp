#pragma once

#include <fmt/format.h>

#include <chrono>
#include <string>
#include <string_view>
#include <utility>

#include "animation/humanoid/map_humanoid.hpp"
#include "scene/asset/ragdoll_asset.hpp"

namespace lutka::cli {

/// Whether --quiet was given.
[[nodiscard]] bool isQuiet();

/// Prints to stdout, well-formed and with control characters but line breaks as blanks: paths may bring all along.
void printClean(std::string_view text);

/// Prints what is for people to stdout, but not with --quiet.
template <class... Args>
void tell(fmt::format_string<Args...> format, Args&&... args) {
    if (!isQuiet()) printClean(fmt::format(format, std::forward<Args>(args)...));
}

/// With --verbose: tells on stderr how long its life took.
class Stopwatch {
  public:
    explicit Stopwatch(std::string what);
    ~Stopwatch();
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    std::string what_;
    std::chrono::steady_clock::time_point begun_;
};

/// A bar on stderr, with the time left, while that is a terminal; silent otherwise and with --quiet.
class Progress {
  public:
    Progress(std::string what, int total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void at(int done);

  private:
    std::string what_;
    int total_;
    bool terminal_;
    std::chrono::steady_clock::time_point begun_;
    std::chrono::steady_clock::time_point drawn_;
};

/// Prints the character's and the map's warnings to stderr, one a line.
void printWarnings(const animation::Character& character);
void printWarnings(const animation::HumanoidMap& map);
/// Both, and a word when a profile of another rig was bound by role.
void printWarnings(const scene::RagdollAsset& asset);

}  // namespace lutka::cli
