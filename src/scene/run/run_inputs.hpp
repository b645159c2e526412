#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// A push at the start of a step.
struct TimedHit {
    int step = 0;  ///< Counted from 0.
    int doll = 0;
    int body = 0;
    vec3 impulse{0, 0, 0};    ///< N s, world.
    vec3 bodyPoint{0, 0, 0};  ///< Where it is pushed, body space.
    friend bool operator==(const TimedHit&, const TimedHit&) = default;
};

/// A pull that holds for some steps.
struct TimedPull {
    int from = 0;   ///< The first step, and
    int until = 0;  ///< the first without it.
    int doll = 0;
    int body = 0;
    vec3 bodyPoint{0, 0, 0};    ///< Body space.
    vec3 worldTarget{0, 0, 0};  ///< Metres.
    float maxForceN = 1500.0F;
    friend bool operator==(const TimedPull&, const TimedPull&) = default;
};

/// What a run was made of, in place of what it came to (Recording): how it began, the pushes and pulls with their
/// moments, and hashes of all bodies on the way, by which a run from the same inputs is held against it. The file is
/// described in docs/recording.md.
struct RunInputs {
    static constexpr int kVersion = 1;
    static constexpr int kStepsACheck = 60;

    /// How all bodies were after `step` steps: a hash each, doll by doll, then the props.
    struct Check {
        int step = 0;
        std::vector<std::uint32_t> bodies;
        friend bool operator==(const Check&, const Check&) = default;
    };

    std::string program;        ///< Version and instruction set that made it: what to look at first where bits differ.
    std::string model;          ///< The character's name.
    std::uint64_t profile = 0;  ///< Hash of the profiles' files; see profilesHash().
    std::map<std::string, std::string>
        settings;  ///< What else says how it began; whoever runs it gives them a meaning.
    std::vector<TimedHit> hits;
    std::vector<TimedPull> pulls;
    int steps = 0;
    std::vector<Check> checks;  ///< Before the first step, after each kStepsACheck, and after the last.

    friend bool operator==(const RunInputs&, const RunInputs&) = default;
};

/// Of all profiles of a simulation, as their files would be.
[[nodiscard]] std::uint64_t profilesHash(const Simulation& simulation);

/// Inputs of a run that is about to begin, with the check of its start. `program`: name and version of who runs it.
[[nodiscard]] RunInputs beginInputs(const Simulation& simulation, const std::string& program);

/// Gives a simulation the pushes and pulls of its inputs: call before each step. Not for runs that spare dolls
/// (SimulationOptions::shed). What names a doll or body that is not there is left out.
class InputPlayer {
  public:
    /// Both must outlive the player.
    InputPlayer(const RunInputs& inputs, Simulation& simulation);
    void beforeStep();

  private:
    const RunInputs& inputs_;
    Simulation& simulation_;
    std::vector<physics::DragId> drags_;  // one a pull
};

/// Call after each step of a run that is recorded; `last` where it ends there.
void noteStep(const Simulation& simulation, bool last, RunInputs& inputs);

/// The first body that is not as it was, in a run from the same inputs.
struct InputDifference {
    int step = 0;       ///< The check that found it; the one before found none.
    int doll = -1;      ///< -1: a prop.
    int body = 0;       ///< Of the doll, or which prop.
    int differing = 0;  ///< How many bodies differ there.
};
/// Call before the first step and after each: nothing where there is no check or all is as it was. Other numbers of
/// bodies differ in body 0 of doll 0.
[[nodiscard]] std::optional<InputDifference> differenceFrom(const Simulation& simulation, const RunInputs& inputs);

/// Whether a file's name says that it holds inputs: *.inputs.json.
[[nodiscard]] bool isInputsFile(const std::filesystem::path& file);
[[nodiscard]] std::string inputsToJson(const RunInputs& inputs);
[[nodiscard]] Result<void> saveInputs(const std::filesystem::path& file, const RunInputs& inputs);
/// `source` names it in messages. Fails with ErrorCode::input, all problems with their JSON pointers.
[[nodiscard]] Result<RunInputs> inputsFromJson(std::string_view text, std::string_view source);
[[nodiscard]] Result<RunInputs> loadInputs(const std::filesystem::path& file);

}  // namespace lutka::scene
