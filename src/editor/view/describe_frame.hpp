#pragma once

#include <filesystem>
#include <span>

#include <array>

#include "editor/states/workspace.hpp"
#include "render/frame.hpp"
#include "render/legend.hpp"
#include "scene/draw/draw_simulation.hpp"

namespace lutka::editor {

/// What the picture shows beside the dolls.
struct ViewSettings {
    scene::DebugLayers layers;
    bool debug = false;  ///< F3: whether `layers` are drawn.
    float skinOpacity = 1.0F;
    bool vsync = true;             ///< The application's window waits for the monitor.
    bool dualQuaternions = false;  ///< Skinning that keeps the volume of twisted limbs.
    bool panels = true;
    bool help = false;
    bool gallery = false;        ///< Of recent models.
    bool clips = false;          ///< The timeline of the file's clips.
    bool ghost = false;          ///< The pose that puppets follow, coloured by how far they are from it.
    bool strength = false;       ///< What is left of puppets' strength, as a colour.
    std::filesystem::path sky;   ///< A panorama (*.hdr) that lights the scene; empty: the plain sky.
    bool skyBackground = false;  ///< And is seen behind it.
};

/// Fills in what the editor's view shows: camera, dolls, objects, debug layers, the selection and its handles, pins.
/// `characters` are the uploaded ones of the document's assets; `drawer` keeps its buffers from frame to frame.
void describeFrame(const Workspace& workspace, const ViewSettings& view, scene::SimulationDrawer& drawer,
                   std::span<const render::CharacterHandle> characters, render::FrameDescription& frame);

/// What the colours of puppets' targets and of their strength mean, from the one end to the other.
[[nodiscard]] std::array<render::LegendEntry, 2> targetLegend();
[[nodiscard]] std::array<render::LegendEntry, 2> strengthLegend();

}  // namespace lutka::editor
