#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "outputs.hpp"
#include "render/frame_writer.hpp"
#include "render/gl/gl_context.hpp"
#include "render/gl/renderer.hpp"
#include "run_simulation.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "scene/draw/film_camera.hpp"
#include "scene/measure/report.hpp"
#include "scene/run/recording.hpp"

namespace lutka::cli {
namespace {

struct RenderCommandOptions {
    SimulateOptions simulate;
    std::filesystem::path out;
    std::string size = "960x540";
    std::string debug;
    std::string skinning = "linear";
    std::optional<double> fps;
    float opacity = 1.0F;
    std::optional<float> yawDeg;
    std::optional<float> pitchDeg;
    std::optional<float> distance;
    bool frames = false;
    bool follow = false;
    bool legend = true;
    std::filesystem::path sky;
    bool skyBackground = false;

    [[nodiscard]] double framesPerSecond() const { return fps.value_or(30.0); }
};

/// Everything that draws: made once, used a frame at a time.
class Painter {
  public:
    Painter(const RenderCommandOptions& options, Run& run)
        : options_(options),
          size_(parseSize(options.size)),
          layers_(orLeave(scene::parseDebugLayers(options.debug))),
          context_(orLeave(render::GlContext::createHeadless())),
          renderer_(orLeave(render::Renderer::create(context_))) {
        orLeave(render::Renderer::checkSize(size_));
        drawer_.skinning =
            options.skinning == "dual" ? animation::SkinningMethod::dualQuaternion : animation::SkinningMethod::linear;
        if (!options.sky.empty()) {
            const render::Environment sky = orLeave(render::loadHdr(options.sky));
            renderer_.setEnvironment(&sky);
            frame_.sky.environment = true;
            frame_.sky.environmentBackground = options.skyBackground;
        }
        if (layers_.bullet && run.simulation->options().world.solver == physics::SolverKind::crowd)
            spdlog::warn("--debug bullet draws nothing with the crowd solver; add --solver bullet");
        showBodiesForSkins(run);
        legend_ = scene::legendOf(layers_);
        for (const auto& asset : run.cast.assets)
            characters_.push_back(orLeave(renderer_.uploadCharacter(asset->character)));
        view_.emplace(run.simulation->scenario(), size_.aspect());
        if (options.follow) view_->followDoll(0);
        if (options.yawDeg) view_->camera.yaw = radians(*options.yawDeg);
        if (options.pitchDeg) view_->camera.pitch = radians(*options.pitchDeg);
        if (options.distance) view_->keepDistance(*options.distance);
        frame_.camera = view_->camera;
        watch(*run.simulation);
    }

    /// The camera goes along as in a film, `seconds` since it did so last.
    void follow(scene::Simulation& simulation, float alpha, float seconds) {
        view_->update(simulation, alpha, seconds);
        frame_.camera = view_->camera;
        watch(simulation);
    }

    void paint(scene::Simulation& simulation, float alpha, float seconds) {
        frame_.clear();
        follow(simulation, alpha, seconds);
        drawer_.draw(simulation, characters_, layers_, alpha, options_.opacity, frame_);
        renderer_.draw(frame_, size_);
        renderer_.readPixels(image_);
        if (context_.lost()) leave(render::GlContext::lostError());
        if (options_.legend) render::drawLegend(image_, legend_);
    }

    [[nodiscard]] const render::Image& image() const { return image_; }
    [[nodiscard]] render::Extent size() const { return size_; }

  private:
    // A file of joints alone (motion capture) would be an empty floor.
    void showBodiesForSkins(const Run& run) {
        const auto& assets = run.cast.assets;
        const bool skinned = std::any_of(assets.begin(), assets.end(),
                                         [](const auto& asset) { return !asset->character.meshes.empty(); });
        if (skinned || !options_.debug.empty()) return;
        layers_.solidCapsules = true;
        spdlog::warn("the file has no skin: the bodies are drawn in its place (--debug says which layers are)");
    }

    // What is far from the camera is spared (--shed) unless an eye was asked for.
    void watch(scene::Simulation& simulation) const {
        if (options_.simulate.eye.empty()) simulation.setEye(render::eyeOf(frame_.camera));
    }

    const RenderCommandOptions& options_;
    render::Extent size_;
    scene::DebugLayers layers_;
    render::GlContext context_;
    render::Renderer renderer_;
    std::vector<render::CharacterHandle> characters_;
    render::FrameDescription frame_;
    std::optional<scene::FilmCamera> view_;
    scene::SimulationDrawer drawer_;
    render::Image image_;
    std::vector<render::LegendEntry> legend_;
};

// The last picture of the film, without the others: a single doll that lies is seen as near as there. One that is to
// be in the middle is so at once.
void renderPicture(const RenderCommandOptions& options, Run& run, Painter& painter) {
    const bool single = run.simulation->dollCount() == 1 && !options.follow;
    if (single) painter.follow(*run.simulation, 1.0F, 0.0F);
    execute(options.simulate, run, [&](scene::Simulation& simulation) {
        if (single) painter.follow(simulation, 1.0F, simulation.options().dt);
    });
    painter.paint(*run.simulation, 1.0F, 0.0F);
    orLeave(render::savePng(painter.image(), options.out));
}

// Frames come at their own rate, between the steps' states.
void renderFrames(const RenderCommandOptions& options, Run& run, Painter& painter) {
    auto writer = orLeave(render::FrameWriter::open(options.out, painter.size(), options.framesPerSecond()));
    painter.paint(*run.simulation, 1.0F, 0.0F);
    orLeave(writer.add(painter.image()));
    double next = 1.0 / options.framesPerSecond();
    execute(options.simulate, run, [&](scene::Simulation& simulation) {
        const double dt = static_cast<double>(simulation.options().dt);
        const double now = simulation.seconds();
        for (; next <= now + 1e-9; next += 1.0 / options.framesPerSecond()) {
            painter.paint(simulation, static_cast<float>(1.0 - (now - next) / dt),
                          1.0F / static_cast<float>(options.framesPerSecond()));
            orLeave(writer.add(painter.image()));
        }
    });
    orLeave(writer.finish());
}

void runRender(RenderCommandOptions& options) {
    options.simulate.ragdoll.model.textures = true;
    const bool printed = isStandardOutput(options.out);
    checkEnding("--output", options.out, {".png", ".mp4", ".gif"}, options.frames);
    if (printed && options.frames) {
        leave({ErrorCode::usage, "frames are files of their own, and stdout is one", "--frames", "name a .png"});
    }
    for (const auto& file : {options.out, options.simulate.bakedOut, options.simulate.meshOut, options.simulate.report,
                             options.simulate.recordTo})
        keepInputs(file, {options.sky});
    const bool sequence = options.frames || render::FrameWriter::isVideo(options.out);
    options.simulate.bakeFps = options.fps;
    Run run = prepare(options.simulate, options.out);
    Painter painter(options, run);
    if (sequence) {
        renderFrames(options, run, painter);
    } else {
        renderPicture(options, run, painter);
    }
    if (printed || options.simulate.fillsStandardOutput()) return;
    if (options.simulate.json) {
        fmt::print("{}", scene::reportJson(*run.simulation));
        return;
    }
    if (run.replay) {
        tell("replayed {} steps of {}\n", run.steps, run.replay->model);
    } else {
        tell("{}", scene::reportText(*run.simulation));
    }
    for (const auto& file : {options.out, options.simulate.bakedOut, options.simulate.meshOut, options.simulate.report,
                             options.simulate.recordTo}) {
        if (!file.empty()) tell("  wrote {}\n", file.string());
    }
}

}  // namespace

void addRender(const Command& app) {
    auto options = std::make_shared<RenderCommandOptions>();
    const Command command = app.add("render", "Draw the fall to a picture or a video, without a display");
    options->simulate.addTo(command);
    const Option sky =
        command.option("--sky", options->sky, "light from a panorama (*.hdr) in place of the default sky");
    command.flag("--sky-background", options->skyBackground, "show the panorama behind the scene").needs(sky);
    command
        .option("-o,--output", options->out, "FILE.png (the last moment), FILE.mp4 or FILE.gif; - for a PNG on stdout")
        .required();
    command.option("--size", options->size, "WIDTHxHEIGHT in pixels").showDefault();
    command
        .option("--fps", options->fps,
                "frames a second of a video (default: 30) and, when given, of --out and --mesh-sequence")
        .range(1.0, 240.0);
    command.flag("--frames", options->frames, "with a .png: the whole fall as FILE_0000.png, FILE_0001.png …");
    command.option("--debug", options->debug, "layers over the picture, joined by commas: " + scene::debugLayerNames());
    command.flag("!--no-legend", options->legend, "leave the colours' meaning out of the picture");
    command.option("--opacity", options->opacity, "of the skin, 0 to 1").range(0.0, 1.0);
    command.option("--skinning", options->skinning, "linear, or dual: quaternions that keep a twisted limb's volume")
        .oneOf({"linear", "dual"})
        .showDefault();
    command.flag("--follow", options->follow, "keep the first doll in the middle of the picture and as large as fits");
    command.option("--yaw", options->yawDeg, "camera's heading in degrees; 0 looks at the front")
        .range(-3600.0, 3600.0);
    command.option("--pitch", options->pitchDeg, "camera's height in degrees").range(-89.0, 89.0);
    command.option("--distance", options->distance, "camera's distance in metres").range(0.01, 1000.0);
    command.onRun([options] { runRender(*options); });
}

}  // namespace lutka::cli
