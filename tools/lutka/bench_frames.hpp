#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "physics/world/world_settings.hpp"
#include "render/extent.hpp"
#include "scene/asset/ragdoll_asset.hpp"
#include "scene/measure/report.hpp"

namespace lutka::cli {

/// One case of the sweep: so many dolls stepped, posed, drawn and shown, a step of 1/60 s a frame.
struct FrameCase {
    std::string scene = "spread";
    int count = 1;
    int threads = 1;
    bool window = false;  ///< Else drawn without a display, and each picture read back.
    bool vsync = false;   ///< Of the window.
    physics::SolverKind solver = physics::SolverKind::crowd;
    bool sleeping = false;
    int warmUp = 60;  ///< Frames that are not measured.
    int frames = 300;
    float seconds = 20.0F;  ///< Measuring ends early after so long.
    render::Extent size{1280, 720};
};

/// What a frame took, milliseconds, means over the measured frames where not said otherwise.
struct FrameFigures {
    int frames = 0;
    double fps = 0.0;  ///< Frames over the time that all took.
    scene::StepSummary frame;
    double simulateMs = 0.0;
    double broadphaseMs = 0.0;  ///< Parts of simulateMs.
    double narrowphaseMs = 0.0;
    double solverMs = 0.0;
    double poseMs = 0.0;
    double drawMs = 0.0;   ///< The frame's lists and the driver's calls.
    double showMs = 0.0;   ///< Until the picture is there: swapping buffers, with VSync the wait; reading back.
    std::string renderer;  ///< The driver's words.
};

/// Runs the case. Fails as loading the scene, opening the context or the renderer do.
[[nodiscard]] Result<FrameFigures> measureFrames(const scene::RagdollAsset& asset, const FrameCase& what);

/// The names of what frameCells() gives.
[[nodiscard]] const std::vector<std::string>& frameColumns();
/// A case's cells of the CSV; `error` in place of the figures where there are none.
[[nodiscard]] std::vector<std::string> frameCells(const FrameCase& what, const Result<FrameFigures>& figures);

}  // namespace lutka::cli
