#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "render/color.hpp"
#include "render/legend.hpp"

namespace lutka::scene {

/// Which debug layers are drawn over the picture; debugLayerInfos() says what each shows and in which colours.
struct DebugLayers {
    bool capsules = false;       ///< Wireframe of every body over all; coloured by sleep.
    bool solidCapsules = false;  ///< The same as translucent solids.
    bool skeleton = false;       ///< The bones from joint to joint.
    bool joints = false;         ///< The axes of the joints that own a body.
    bool limits = false;         ///< Arcs (hinge) and cones with twist sector, coloured near and past the limit.
    bool contacts = false;       ///< Contact points and normals of the last substep.
    bool velocities = false;     ///< Linear velocity of each body's centre, 0.1 s long.
    bool centresOfMass = false;  ///< Centre and inertia box of each body.
    bool aabbs = false;          ///< World boxes around the bodies.
    bool sleep = false;          ///< The skins coloured by sleep.
    bool bullet = false;         ///< What Bullet's own debug drawer shows; nothing in the crowd solver's world.
};

/// A layer with its words and its legend, for menus.
struct DebugLayerInfo {
    std::string_view name;   ///< On the command line.
    std::string_view title;  ///< In menus.
    std::string_view what;   ///< A sentence.
    bool DebugLayers::*member;
    std::span<const render::LegendEntry> legend;  ///< Its colours and what they mean; may be empty.
};

/// Every layer, in the order of menus.
[[nodiscard]] std::span<const DebugLayerInfo> debugLayerInfos();

/// The names, joined by ", ".
[[nodiscard]] std::string debugLayerNames();

/// Parses names joined by commas. Fails with ErrorCode::usage on a word that is none.
[[nodiscard]] Result<DebugLayers> parseDebugLayers(std::string_view list);

/// The colours of the layers that are on, each once.
[[nodiscard]] std::vector<render::LegendEntry> legendOf(const DebugLayers& layers);

/// The colours of debug draw.
namespace debugColors {
inline constexpr render::Color awake{104, 205, 92, 255};
inline constexpr render::Color asleep{128, 142, 178, 255};
inline constexpr render::Color limit{72, 200, 222, 255};
inline constexpr render::Color nearLimit = render::colors::yellow;
inline constexpr render::Color pastLimit = render::colors::red;
inline constexpr render::Color presentAngle = render::colors::white;
inline constexpr render::Color velocity = render::colors::magenta;
inline constexpr render::Color mass = render::colors::orange;
inline constexpr render::Color bounds = render::colors::grey;
inline constexpr render::Color bone{205, 209, 214, 255};
inline constexpr render::Color touching = render::colors::yellow;
inline constexpr render::Color penetrating = render::colors::red;
}  // namespace debugColors

}  // namespace lutka::scene
