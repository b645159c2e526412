#include "bench_frames.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>

#include "render/gl/renderer.hpp"
#include "scene/draw/draw_simulation.hpp"
#include "scene/draw/film_camera.hpp"
#include "scene/run/simulation.hpp"

namespace lutka::cli {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
}

/// The dolls with all that shows them.
class Stage {
  public:
    Stage(const FrameCase& what, std::unique_ptr<scene::Simulation> simulation, render::GlContext context,
          render::Renderer renderer)
        : what_(what),
          simulation_(std::move(simulation)),
          context_(std::move(context)),
          renderer_(std::move(renderer)),
          view_(simulation_->scenario(), what.size.aspect()) {}

    Result<void> upload(const animation::Character& character) {
        auto handle = renderer_.uploadCharacter(character);
        if (!handle) return handle.error();
        character_ = handle.value();
        return {};
    }

    void frame() {
        const auto start = Clock::now();
        simulation_->step();
        const auto stepped = Clock::now();
        frame_.clear();
        view_.update(*simulation_, 1.0F, simulation_->options().dt);
        frame_.camera = view_.camera;
        drawer_.draw(*simulation_, character_, layers_, 1.0F, 1.0F, frame_);
        renderer_.draw(frame_, what_.size);
        const auto drawn = Clock::now();
        show();
        const auto shown = Clock::now();
        const physics::StepTimes times = simulation_->world().stepTimes();
        note(millisecondsBetween(start, stepped), times, millisecondsBetween(stepped, drawn),
             millisecondsBetween(drawn, shown));
    }

    void beginMeasuring() {
        sums_ = {};
        frameMs_.clear();
    }
    [[nodiscard]] int measured() const { return static_cast<int>(frameMs_.size()); }
    [[nodiscard]] FrameFigures figures() const {
        FrameFigures figures = sums_;
        const double frames = std::max(measured(), 1);
        double total = 0.0;
        for (const float ms : frameMs_)
            total += static_cast<double>(ms);
        figures.frames = measured();
        figures.fps = total > 0.0 ? 1000.0 * frames / total : 0.0;
        figures.frame = scene::summarise(frameMs_);
        for (double* sum : {&figures.simulateMs, &figures.broadphaseMs, &figures.narrowphaseMs, &figures.solverMs,
                            &figures.poseMs, &figures.drawMs, &figures.showMs})
            *sum /= frames;
        figures.renderer = context_.description();
        return figures;
    }

  private:
    void show() {
        if (!what_.window) {
            renderer_.readPixels(image_);
            return;
        }
        renderer_.present(context_.framebufferSize());
        context_.swapBuffers();
    }

    void note(double simulateMs, const physics::StepTimes& times, double drawMs, double showMs) {
        sums_.simulateMs += simulateMs;
        sums_.broadphaseMs += times.broadphaseMs;
        sums_.narrowphaseMs += times.narrowphaseMs;
        sums_.solverMs += times.solverMs;
        sums_.poseMs += drawer_.poseMs();
        sums_.drawMs += drawMs - drawer_.poseMs();
        sums_.showMs += showMs;
        frameMs_.push_back(static_cast<float>(simulateMs + drawMs + showMs));
    }

    const FrameCase& what_;
    std::unique_ptr<scene::Simulation> simulation_;
    render::GlContext context_;
    render::Renderer renderer_;  // dies before its context
    scene::FilmCamera view_;
    scene::SimulationDrawer drawer_;
    scene::DebugLayers layers_;
    render::CharacterHandle character_;
    render::FrameDescription frame_;
    render::Image image_;
    FrameFigures sums_;
    std::vector<float> frameMs_;
};

Result<std::unique_ptr<scene::Simulation>> simulationOf(const scene::RagdollAsset& asset, const FrameCase& what) {
    auto scenario = scene::makeScenario({.name = what.scene, .count = what.count, .seed = 1}, asset);
    if (!scenario) return scenario.error();
    scene::SimulationOptions options;
    options.world.solver = what.solver;
    options.world.threads = what.threads;
    options.world.sleeping = what.sleeping;
    options.measure = false;
    return scene::Simulation::create(asset, std::move(scenario).value(), options);
}

}  // namespace

Result<FrameFigures> measureFrames(const scene::RagdollAsset& asset, const FrameCase& what) {
    auto simulation = simulationOf(asset, what);
    if (!simulation) return simulation.error();
    auto context = what.window ? render::GlContext::createWindow({"Lutka bench", what.size, true, what.vsync})
                               : render::GlContext::createHeadless();
    if (!context) return context.error();
    auto renderer = render::Renderer::create(
        context.value(), render::rendererOptions(render::RenderQuality::automatic, context.value()));
    if (!renderer) return renderer.error();
    Stage stage(what, std::move(simulation).value(), std::move(context).value(), std::move(renderer).value());
    if (auto uploaded = stage.upload(asset.character); !uploaded) return uploaded.error();
    const auto start = Clock::now();
    const double mostMs = 1000.0 * static_cast<double>(what.seconds);
    // A slow case warms up for a fourth of its time at most.
    for (int i = 0; i < what.warmUp && millisecondsBetween(start, Clock::now()) < 0.25 * mostMs; ++i)
        stage.frame();
    stage.beginMeasuring();
    const auto begun = Clock::now();
    while (stage.measured() < what.frames &&
           (stage.measured() == 0 || millisecondsBetween(begun, Clock::now()) < mostMs))
        stage.frame();
    return stage.figures();
}

const std::vector<std::string>& frameColumns() {
    static const std::vector<std::string> kNames{
        "mode",           "scene",     "count",    "threads", "vsync",   "solver",      "sleeping",
        "frames",         "fps",       "frame_ms", "p50_ms",  "p99_ms",  "simulate_ms", "broadphase_ms",
        "narrowphase_ms", "solver_ms", "pose_ms",  "draw_ms", "show_ms", "renderer",    "error"};
    return kNames;
}

std::vector<std::string> frameCells(const FrameCase& what, const Result<FrameFigures>& figures) {
    std::vector<std::string> cells{what.window ? "window" : "headless", what.scene,
                                   std::to_string(what.count),          std::to_string(what.threads),
                                   what.vsync ? "on" : "off",           std::string(physics::solverName(what.solver)),
                                   what.sleeping ? "on" : "off"};
    if (!figures) {
        cells.resize(frameColumns().size());
        cells.back() = figures.error().text();
        return cells;
    }
    const FrameFigures& f = figures.value();
    cells.push_back(std::to_string(f.frames));
    cells.push_back(fmt::format("{:.2f}", f.fps));
    for (const double ms :
         {static_cast<double>(f.frame.mean), static_cast<double>(f.frame.p50), static_cast<double>(f.frame.p99),
          f.simulateMs, f.broadphaseMs, f.narrowphaseMs, f.solverMs, f.poseMs, f.drawMs, f.showMs})
        cells.push_back(fmt::format("{:.4f}", ms));
    cells.push_back(f.renderer);
    cells.emplace_back();
    return cells;
}

}  // namespace lutka::cli
