#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/run/simulation.hpp"

namespace lutka::scene {

/// The bodies of every doll and prop at every step of a run, to be played back without physics.
///
/// The file (docs/recording.md): one line of JSON {"format": "lutka.recording", "version": 1, …}, then for each step
/// seven little-endian 32-bit floats a body and prop: rotation x y z w, translation x y z (metres, world).
struct Recording {
    static constexpr int kVersion = 2;  ///< 1 knows no mixed crowds and is still written for all others.

    std::string model;  ///< The character's name.
    std::string scene;
    int figure = 0;  ///< Which of the first doll's file, counted from 1; 0: the file holds one.
    float dt = 1.0F / 60.0F;
    int dolls = 0;
    int bodiesPerDoll = 0;          ///< Of each, when they are alike; else of the first.
    std::vector<int> bodiesOfDoll;  ///< One a doll, for a mixed crowd; empty when all have bodiesPerDoll.
    int props = 0;
    std::vector<RigidTransform> frames;  ///< steps × (all dolls' bodies + props)

    [[nodiscard]] std::size_t frameSize() const {
        std::size_t bodies = static_cast<std::size_t>(dolls) * static_cast<std::size_t>(bodiesPerDoll);
        if (!bodiesOfDoll.empty()) {
            bodies = 0;
            for (const int count : bodiesOfDoll)
                bodies += static_cast<std::size_t>(count);
        }
        return bodies + static_cast<std::size_t>(props);
    }
    /// A step's frames; `step` in [0, steps()).
    [[nodiscard]] std::span<const RigidTransform> frame(int step) const {
        return std::span(frames).subspan(frameSize() * static_cast<std::size_t>(step), frameSize());
    }
    [[nodiscard]] int steps() const { return frameSize() == 0 ? 0 : static_cast<int>(frames.size() / frameSize()); }
};

/// An empty recording of this simulation.
[[nodiscard]] Recording beginRecording(const Simulation& simulation);
/// Appends the simulation's present state.
void record(Simulation& simulation, Recording& recording);

[[nodiscard]] Result<void> saveRecording(const std::filesystem::path& file, const Recording& recording);
/// A recording as its file's bytes; `source` names it in messages. Fails with ErrorCode::input when it isn't a
/// recording, holds more or fewer steps than it says, or what no body can be at: not finite, no rotation, beyond 10⁹ m.
[[nodiscard]] Result<Recording> recordingFromBytes(std::span<const unsigned char> bytes,
                                                   const std::filesystem::path& source);
/// The same of a file of up to 4 GiB; its first line and its size are judged before memory is taken.
[[nodiscard]] Result<Recording> loadRecording(const std::filesystem::path& file);

}  // namespace lutka::scene
