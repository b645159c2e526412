#include "scene/draw/debug_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace lutka::scene {
namespace {

using render::LegendEntry;

constexpr std::array<LegendEntry, 2> kSleepLegend{{
    {debugColors::awake, "body awake"},
    {debugColors::asleep, "body asleep"},
}};
constexpr std::array<LegendEntry, 1> kBoneLegend{{{debugColors::bone, "bone"}}};
constexpr std::array<LegendEntry, 3> kAxisLegend{{
    {render::colors::red, "joint axis x"},
    {render::colors::green, "joint axis y"},
    {render::colors::blue, "joint axis z"},
}};
constexpr std::array<LegendEntry, 4> kLimitLegend{{
    {debugColors::limit, "limit"},
    {debugColors::presentAngle, "present angle"},
    {debugColors::nearLimit, "within 5 degrees of the limit"},
    {debugColors::pastLimit, "past the limit"},
}};
constexpr std::array<LegendEntry, 2> kContactLegend{{
    {debugColors::touching, "contact and its normal"},
    {debugColors::penetrating, "penetrating contact"},
}};
constexpr std::array<LegendEntry, 1> kVelocityLegend{{{debugColors::velocity, "velocity, way of 0.1 s"}}};
constexpr std::array<LegendEntry, 1> kMassLegend{{{debugColors::mass, "centre of mass, inertia box"}}};
constexpr std::array<LegendEntry, 1> kBoundsLegend{{{debugColors::bounds, "bounding box"}}};
// Bullet's own colours, not ours to choose (btIDebugDraw::DefaultColors and the worlds' states).
constexpr std::array<LegendEntry, 5> kBulletLegend{{
    {{255, 255, 255, 255}, "Bullet: shape awake"},
    {{0, 255, 0, 255}, "Bullet: shape asleep, or static"},
    {{255, 0, 0, 255}, "Bullet: bounding box"},
    {{0, 0, 0, 255}, "Bullet: limit"},
    {{255, 255, 0, 255}, "Bullet: contact"},
}};

constexpr std::array<DebugLayerInfo, 11> kLayers{{
    {"capsules", "Capsules", "Wireframes of the bodies, coloured by sleep", &DebugLayers::capsules, kSleepLegend},
    {"solids", "Solid capsules", "The same as translucent solids", &DebugLayers::solidCapsules, kSleepLegend},
    {"skeleton", "Skeleton", "The bones from joint to joint", &DebugLayers::skeleton, kBoneLegend},
    {"joints", "Joint axes", "The axes of mapped joints: x, y, z in red, green, blue", &DebugLayers::joints,
     kAxisLegend},
    {"limits", "Limits", "Arcs of hinges, cones with twist sector, the present angle in them", &DebugLayers::limits,
     kLimitLegend},
    {"contacts", "Contacts", "Contact points and normals of the last substep", &DebugLayers::contacts, kContactLegend},
    {"velocities", "Velocities", "Velocity of each body's centre, a tenth of a second long", &DebugLayers::velocities,
     kVelocityLegend},
    {"com", "Centres of mass", "With boxes of the bodies' inertia", &DebugLayers::centresOfMass, kMassLegend},
    {"aabbs", "Bounding boxes", "World boxes around the bodies", &DebugLayers::aabbs, kBoundsLegend},
    {"sleep", "Sleep", "The skins coloured by sleep", &DebugLayers::sleep, kSleepLegend},
    {"bullet", "Bullet's own", "What Bullet's debug drawer shows, with the solvers that are Bullet worlds",
     &DebugLayers::bullet, kBulletLegend},
}};

}  // namespace

std::span<const DebugLayerInfo> debugLayerInfos() {
    return kLayers;
}

std::string debugLayerNames() {
    std::string names;
    for (const DebugLayerInfo& layer : kLayers)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", layer.name);
    return names;
}

Result<DebugLayers> parseDebugLayers(std::string_view list) {
    DebugLayers layers;
    while (!list.empty()) {
        const std::string_view word = list.substr(0, list.find(','));
        list.remove_prefix(std::min(word.size() + 1, list.size()));
        const auto* known = std::find_if(kLayers.begin(), kLayers.end(),
                                         [&](const DebugLayerInfo& layer) { return layer.name == word; });
        if (known == kLayers.end()) {
            return Error{ErrorCode::usage, fmt::format("there is no debug layer named '{}'", word), "--debug",
                         "the layers are " + debugLayerNames()};
        }
        layers.*(known->member) = true;
    }
    return layers;
}

std::vector<LegendEntry> legendOf(const DebugLayers& layers) {
    std::vector<LegendEntry> legend;
    for (const DebugLayerInfo& layer : kLayers) {
        if (!(layers.*layer.member)) continue;
        for (const LegendEntry& entry : layer.legend) {
            const auto same = [&](const LegendEntry& known) { return known.text == entry.text; };
            if (std::none_of(legend.begin(), legend.end(), same)) legend.push_back(entry);
        }
    }
    return legend;
}

}  // namespace lutka::scene
