#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/simulation.hpp"

namespace lutka::scene {

/// The bodies of every doll and prop at every step of a run, to be played back without physics.
///
/// The file (docs/recording.md): one line of JSON {"format": "lutka.recording", "version": 1, …}, then for each step
/// seven little-endian 32-bit floats a body and prop: rotation x y z w, translation x y z (metres, world).
struct Recording {
    static constexpr int kVersion = 1;

    std::string model;  ///< The character's name.
    std::string scene;
    float dt = 1.0F / 60.0F;
    int dolls = 0;
    int bodiesPerDoll = 0;
    int props = 0;
    std::vector<RigidTransform> frames;  ///< steps × (dolls · bodiesPerDoll + props)

    [[nodiscard]] std::size_t frameSize() const {
        return static_cast<std::size_t>(dolls) * static_cast<std::size_t>(bodiesPerDoll) +
               static_cast<std::size_t>(props);
    }
    [[nodiscard]] int steps() const { return frameSize() == 0 ? 0 : static_cast<int>(frames.size() / frameSize()); }
};

/// An empty recording of this simulation.
[[nodiscard]] Recording beginRecording(const Simulation& simulation);
/// Appends the simulation's present state.
void record(Simulation& simulation, Recording& recording);

[[nodiscard]] Result<void> saveRecording(const std::filesystem::path& file, const Recording& recording);
/// Fails with ErrorCode::input when the file isn't a recording, is cut short or holds what isn't finite.
[[nodiscard]] Result<Recording> loadRecording(const std::filesystem::path& file);

}  // namespace lutka::scene
