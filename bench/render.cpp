/// What drawing a frame costs: one row a setting, milliseconds of processor time (all threads, so that a software
/// rasteriser's work is counted whole and other programs' is not) and of the GPU's timer queries by pass, medians.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <vector>

#include "animation/import/import_character.hpp"
#include "animation/skinning.hpp"
#include "render/gl/renderer.hpp"

using namespace lutka;
using namespace lutka::render;

namespace {

struct Setting {
    const char* name;
    RendererOptions options;
    bool ambientOcclusion = true;
    bool shadow = true;
};

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

FrameDescription sceneOf(CharacterHandle character, std::span<const animation::SkinMatrix> palette, int count,
                         float aspect) {
    FrameDescription frame;
    for (int i = 0; i < count; ++i) {
        CharacterItem& item = frame.characters.emplace_back();
        item.character = character;
        item.palette = palette;
        const auto across = static_cast<float>(i % 10);
        const int row = i / 10;
        const auto back = static_cast<float>(row);
        item.worldFromModel.translation = count == 1 ? vec3(0) : vec3(across - 4.5F, 0, -back);
    }
    frameSphere(frame.camera, {0, 0.9F, 0}, count == 1 ? 1.2F : 4.0F, aspect);
    return frame;
}

void measure(GlContext& context, const animation::Character& character, const Setting& setting, Extent size, int count,
             int frames) {
    Result<Renderer> made = Renderer::create(context, setting.options);
    if (!made) throw std::runtime_error(made.error().text());
    Renderer& renderer = made.value();
    const auto handle = renderer.uploadCharacter(character);
    if (!handle) throw std::runtime_error(handle.error().text());
    std::vector<animation::SkinMatrix> palette(character.skeleton.parents.size());
    FrameDescription frame = sceneOf(handle.value(), palette, count, size.aspect());
    frame.ambientOcclusion = setting.ambientOcclusion;
    frame.sun.castsShadow = setting.shadow;
    std::vector<double> processor;
    std::array<std::vector<double>, kRenderPassCount> passes;
    for (int i = 0; i < frames; ++i) {
        const std::clock_t start = std::clock();
        renderer.draw(frame, size);
        static_cast<void>(renderer.readPixels());
        processor.push_back(1000.0 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
        if (!renderer.stats().gpu.known) continue;
        for (std::size_t pass = 0; pass < kRenderPassCount; ++pass)
            passes[pass].push_back(renderer.stats().gpu.ms[pass]);
    }
    fmt::print("{},{},{}x{},{:.1f}", setting.name, count, size.width, size.height, median(processor));
    for (const auto& pass : passes)
        fmt::print(",{:.1f}", pass.empty() ? 0.0 : median(pass));
    fmt::print("\n");
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Times the renderer");
    std::string model;
    int frames = 12;
    app.add_option("MODEL", model)->required();
    app.add_option("--frames", frames);
    CLI11_PARSE(app, argc, argv);
    auto context = GlContext::createHeadless();
    if (!context) {
        fmt::print(stderr, "{}\n", context.error().text());
        return 6;
    }
    const auto character = animation::importCharacter(model);
    if (!character) {
        fmt::print(stderr, "{}\n", character.error().text());
        return 3;
    }
    fmt::print("setting,dolls,size,processorMs");
    for (std::size_t pass = 0; pass < kRenderPassCount; ++pass)
        fmt::print(",{}Ms", renderPassName(static_cast<RenderPass>(pass)));
    fmt::print("\n");
    const RendererOptions fast = rendererOptions(RenderQuality::fast, context.value());
    const std::vector<Setting> settings = {
        {"best", {}},
        {"best-no-occlusion", {}, false},
        {"best-no-shadow", {}, true, false},
        {"one-sample", {.samples = 1}},
        {"fast", fast},
        {"fast-no-shadow", fast, true, false},
    };
    for (const int count : {1, 100}) {
        for (const Setting& setting : settings)
            measure(context.value(), character.value(), setting, {1280, 720}, count, frames);
    }
    return 0;
}
