#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "command_line.hpp"
#include "core/result.hpp"
#include "render/extent.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::cli {

/// What ends a command early; main() turns it into the process's exit code.
struct Exit {
    int code = 0;
};

/// Prints the error to stderr and leaves with its exit code.
[[noreturn]] void leave(const Error& error);

/// The value, or leave() with the error.
template <class T>
[[nodiscard]] T orLeave(Result<T> result) {
    if (!result) leave(result.error());
    return std::move(result).value();
}
inline void orLeave(const Result<void>& result) {
    if (!result) leave(result.error());
}

/// MODEL, --scale, --up, --figure: what every command that loads a model takes.
struct ModelOptions {
    std::filesystem::path model;
    std::optional<float> scale;
    std::string up;
    std::optional<int> figure;
    bool textures = false;      ///< Set by commands that draw.
    bool inProcess = false;     ///< Read the file in this process.
    bool allowOutside = false;  ///< ImportOptions::allowOutside.
    int importMemoryMiB = 1536;

    void addTo(const Command& app, bool required = true);
    [[nodiscard]] animation::ImportOptions import() const;
};

/// --profile and the options of the fit.
struct RagdollOptions {
    ModelOptions model;
    std::optional<std::filesystem::path> profile;
    bool keepShapes = false;
    bool refit = false;
    std::string rig = "humanoid";
    int maxBodies = 40;
    int shapes = physics::FitOptions{}.mostShapes;
    bool hulls = false;
    std::optional<float> massKg;  ///< Unset: 75 for a humanoid, by volume for any other rig.
    std::string massTable = "de-leva-male";
    std::string massPreset = "anatomical";
    std::string preset = "anatomical";
    std::string bodies;  ///< Extra bodies, comma separated: shoulders,neck,toes,trunk.

    void addTo(const Command& app, bool modelRequired = true);
    [[nodiscard]] scene::LoadOptions load() const;
};

/// --scene with what belongs to it. Unset: what the scene says, or the default of a named one.
struct SceneOptions {
    std::string scene = "drop";  ///< A name, or a file *.scene.json.
    std::optional<int> count;
    std::optional<std::uint64_t> seed;
    std::optional<int> threads;
    std::optional<std::string> solver;

    void addTo(const Command& app);
    /// Whether the scene is a file. A file in place of MODEL is the scene: `model` is empty then.
    bool takeFile(std::filesystem::path& model);
    /// Sets solver and threads where they were asked for.
    void applyTo(physics::WorldSettings& world) const;
};

/// --scene and everything else that simulate and render share.
struct SimulateOptions {
    RagdollOptions ragdoll;
    SceneOptions scene;
    std::optional<float> seconds;
    std::vector<std::string> hold;  ///< Names of bodies that are held where they start.
    std::string pose;
    std::string fromClip;
    std::string clip;  ///< Played instead of falling, as the next three say.
    float clipSpeed = 1.0F;
    bool clipOnce = false;
    bool clipInPlace = false;
    std::string
        puppet;  ///< A muscle preset or `profile`: the clip is followed instead of played, as the next three say.
    float strength = 1.0F;
    bool carriesGravity = false;
    std::optional<float> pinForceN;
    std::vector<std::string> kinematic;
    std::vector<std::string> hits;
    bool getUp = false;
    std::string shed;
    std::vector<float> eye;
    std::filesystem::path bakedOut;
    std::filesystem::path meshOut;
    bool each = false;              ///< bakedOut and meshOut of every doll instead of the first.
    bool together = false;          ///< bakedOut holds every doll.
    bool allKeys = false;           ///< bakedOut keeps every key.
    bool meshSequence = false;      ///< meshOut of every frame instead of the last.
    std::optional<double> bakeFps;  ///< Of bakedOut and meshSequence; unset: the steps'.
    std::filesystem::path report;
    std::filesystem::path recordTo;
    std::filesystem::path replayFrom;
    bool json = false;

    void addTo(const Command& app);
    [[nodiscard]] scene::PuppetPlay puppetPlay() const;
    /// How `scene` is simulated: as it says itself, but for what was asked for.
    [[nodiscard]] scene::SimulationOptions simulation(const scene::EntityScene& scene) const;
    /// Whether one of the outputs is stdout, which then holds nothing else.
    [[nodiscard]] bool fillsStandardOutput() const;

  private:
    /// Length and start pose; gives `--clip`.
    Option addStart(const Command& app);
    /// Muscles; gives `--getup`.
    Option addPuppet(const Command& app, const Option& clipOption);
    void addOutputs(const Command& app, const Option& clipOption);
};

/// The words that an option of named choices takes.
template <class T>
[[nodiscard]] std::vector<std::string> wordsOf(const std::map<std::string, T>& choices) {
    std::vector<std::string> words;
    words.reserve(choices.size());
    for (const auto& [word, choice] : choices)
        words.push_back(word);
    return words;
}

/// --rig: humanoid or any.
Option addRigOption(const Command& app, std::string& rig);

/// --solver, by the names of physics::solverName.
void addSolverOption(const Command& app, std::string& solver);
[[nodiscard]] physics::SolverKind solverFromName(const std::string& name);

/// WIDTHxHEIGHT in pixels, each in [16, 16384]; leaves with wrong usage otherwise.
[[nodiscard]] render::Extent parseSize(const std::string& text);

/// Reads the model and makes its ragdoll; leaves on errors.
[[nodiscard]] std::unique_ptr<scene::RagdollAsset> loadAsset(const RagdollOptions& options);

}  // namespace lutka::cli
