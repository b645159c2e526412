#include "report/pictures.hpp"

#include <optional>
#include <utility>

#include "render/gl/gl_context.hpp"
#include "render/gl/renderer.hpp"
#include "render/png_bytes.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "scene/draw/film_camera.hpp"
#include "scene/draw/scene_extent.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::reporting {
namespace {

constexpr render::Extent kPictureSize{480, 600};
constexpr render::Extent kThumbnailSize{120, 150};
constexpr float kRoom = 0.06F;       // of the picture, on each side of the figure
constexpr float kGlassSkin = 0.25F;  // opacity under bodies and limits

// The scene `drop`, whose figure is let down onto the floor.
std::unique_ptr<scene::Simulation> standingSimulation(const scene::RagdollAsset& asset) {
    auto scenario = scene::makeScenario({.name = "drop"}, asset);
    if (!scenario) return nullptr;
    constexpr float kDropHeight = 1.0F;
    scenario.value().dolls.front().worldFromModel.translation.y -= kDropHeight;
    scene::SimulationOptions options;
    options.measure = false;
    auto simulation = scene::Simulation::create(asset, std::move(scenario).value(), options);
    return simulation ? std::move(simulation).value() : nullptr;
}

}  // namespace

struct Photographer::State {
    State(render::GlContext&& gl, render::Renderer&& made) : context(std::move(gl)), renderer(std::move(made)) {}

    // The next picture uploads its character: another asset may lie where the last one lay.
    void forget() { shown = nullptr; }

    // The character is uploaded when another one than the last is asked for.
    [[nodiscard]] bool show(const scene::RagdollAsset& asset) {
        if (shown == &asset) return handle.valid();
        if (handle.valid()) renderer.removeCharacter(handle);
        const auto uploaded = renderer.uploadCharacter(asset.character);
        handle = uploaded ? uploaded.value() : render::CharacterHandle{};
        shown = &asset;
        return handle.valid();
    }

    std::string paint(scene::Simulation& simulation, const scene::DebugLayers& layers, float opacity,
                      render::Extent size) {
        if (!show(simulation.asset())) return "";
        std::vector<vec3> points;
        scene::addExtentOfDoll(simulation, 0, 1.0F, points);
        render::FrameDescription frame;
        frame.camera = scene::FilmCamera(simulation.scenario(), size.aspect()).camera;
        render::framePoints(frame.camera, points, size.aspect(), {kRoom, kRoom, kRoom, kRoom});
        scene::SimulationDrawer drawer;
        drawer.draw(simulation, handle, layers, 1.0F, opacity, frame);
        renderer.draw(frame, size);
        render::Image image;
        renderer.readPixels(image);
        auto png = render::pngBytes(image);
        return png ? std::move(png).value() : "";
    }

    render::GlContext context;
    render::Renderer renderer;
    const scene::RagdollAsset* shown = nullptr;
    render::CharacterHandle handle;
};

Photographer::Photographer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Photographer::~Photographer() = default;

Result<std::unique_ptr<Photographer>> Photographer::create() {
    auto context = render::GlContext::createHeadless();
    if (!context) return context.error();
    auto renderer = render::Renderer::create(context.value());
    if (!renderer) return renderer.error();
    return std::unique_ptr<Photographer>(
        new Photographer(std::make_unique<State>(std::move(context).value(), std::move(renderer).value())));
}

std::vector<Picture> Photographer::standing(const scene::RagdollAsset& asset) {
    std::vector<Picture> pictures;
    state_->forget();
    const auto simulation = standingSimulation(asset);
    if (simulation == nullptr) return pictures;
    scene::DebugLayers bodies;
    bodies.solidCapsules = true;
    scene::DebugLayers limits;
    limits.limits = true;
    const auto add = [&](const char* caption, const scene::DebugLayers& layers, float opacity) {
        std::string png = state_->paint(*simulation, layers, opacity, kPictureSize);
        if (!png.empty()) pictures.push_back({caption, std::move(png)});
    };
    if (!asset.character.meshes.empty()) add("The skin in its bind pose", {}, 1.0F);
    add("The bodies that stand for it", bodies, kGlassSkin);
    add("The limits of its joints", limits, kGlassSkin);
    return pictures;
}

std::string Photographer::thumbnail(const scene::RagdollAsset& asset) {
    state_->forget();
    const auto simulation = standingSimulation(asset);
    if (simulation == nullptr) return "";
    scene::DebugLayers layers;
    layers.solidCapsules = asset.character.meshes.empty();
    return state_->paint(*simulation, layers, 1.0F, kThumbnailSize);
}

std::string Photographer::moment(scene::Simulation& simulation) {
    scene::DebugLayers layers;
    layers.solidCapsules = simulation.asset().character.meshes.empty();
    return state_->paint(simulation, layers, 1.0F, kPictureSize);
}

}  // namespace lutka::reporting
