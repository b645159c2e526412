// What a frame costs: draw calls, uploads, allocations, GPU memory, times; and the quality for software rasterisers.

#include "gl_fixture.hpp"
#include "support/counting_new.hpp"
#include "support/rigs.hpp"

using namespace lutka;
using namespace lutka::test;
using namespace lutka::render;

namespace {

constexpr Extent kCostSize{160, 120};

struct CrowdToDraw {
    animation::Character biped = makeBiped();
    std::vector<animation::SkinMatrix> palette = bindPalette(biped.skeleton);
    FrameDescription frame;

    CrowdToDraw(GlFixture& gl, int count) {
        const CharacterHandle handle = gl.upload(biped);
        for (int i = 0; i < count; ++i) {
            CharacterItem& item = frame.characters.emplace_back();
            item.character = handle;
            item.palette = palette;
            item.worldFromModel.translation = vec3(static_cast<float>(i % 20) - 10.0F, 0, -static_cast<float>(i / 20));
            if (i % 2 == 1) item.skinning = animation::SkinningMethod::dualQuaternion;
        }
        frameSphere(frame.camera, {0, 0.9F, 0}, 8.0F, kCostSize.aspect());
    }
    void addCapsules() {
        for (const CharacterItem& item : frame.characters) {
            for (int body = 0; body < 15; ++body) {
                const vec3 place = item.worldFromModel.translation + vec3(0, 0.1F * static_cast<float>(body), 0);
                addCapsule(frame.lines, {quat(1, 0, 0, 0), place}, 0.08F, 0.1F, colors::green);
            }
        }
    }
};

}  // namespace

TEST_CASE("two hundred ragdolls with capsules on cost one upload and one draw call more than without") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    CrowdToDraw crowd(*gl, 200);
    gl->renderer.draw(crowd.frame, kCostSize);
    const FrameStats bare = gl->renderer.stats();
    CHECK(bare.debugDrawCalls == 0);
    CHECK(bare.debugUploads == 0);
    CHECK(bare.characterDrawCalls == 1);
    crowd.addCapsules();
    gl->renderer.draw(crowd.frame, kCostSize);
    const FrameStats& with = gl->renderer.stats();
    CHECK(with.debugDrawCalls == 1);
    CHECK(with.debugUploads == 1);
    CHECK(with.drawCalls == bare.drawCalls + 1);
    CHECK(with.uploadedBytes - bare.uploadedBytes ==
          static_cast<long long>(crowd.frame.lines.vertices.size() * sizeof(LineVertex)));
}

TEST_CASE("a frame like the last one allocates nothing") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    CrowdToDraw crowd(*gl, 30);
    crowd.addCapsules();
    PropItem box;
    crowd.frame.props = {box, box};
    crowd.frame.localLights.resize(2);
    for (int i = 0; i < 3; ++i)
        gl->renderer.draw(crowd.frame, kCostSize);
    const std::size_t before = allocationCount();
    for (int i = 0; i < 3; ++i)
        gl->renderer.draw(crowd.frame, kCostSize);
    CHECK(allocationCount() == before);
    // The counter does count.
    CHECK(std::vector<int>(3).size() == 3);
    CHECK(allocationCount() > before);
}

TEST_CASE("the times of every pass that ran arrive from the GPU without being waited for") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    CrowdToDraw crowd(*gl, 5);
    crowd.addCapsules();
    gl->renderer.draw(crowd.frame, kCostSize);
    CHECK_FALSE(gl->renderer.stats().gpu.known);  // nothing can have arrived yet
    for (int i = 0; i < 20 && !gl->renderer.stats().gpu.known; ++i)
        static_cast<void>(gl->picture(crowd.frame, kCostSize));
    const FrameStats& stats = gl->renderer.stats();
    REQUIRE(stats.gpu.known);
    CHECK(stats.gpu.total() > 0.0);
    CHECK(stats.gpu[RenderPass::opaque] > 0.0);
    CHECK(stats.cpu.known);
    CHECK(stats.cpu.total() <= stats.cpuMs);
    CHECK(stats.cpu.total() > 0.0);
    // A pass that does not run has no time.
    crowd.frame.sun.castsShadow = false;
    crowd.frame.lines.clear();
    for (int i = 0; i < 8; ++i)
        static_cast<void>(gl->picture(crowd.frame, kCostSize));
    CHECK(gl->renderer.stats().cpu[RenderPass::shadow] == 0.0);
    CHECK(gl->renderer.stats().gpu[RenderPass::debug] == 0.0);
}

TEST_CASE("each pass has a name of its own") {
    for (std::size_t a = 0; a < kRenderPassCount; ++a) {
        CHECK_FALSE(renderPassName(static_cast<RenderPass>(a)).empty());
        for (std::size_t b = 0; b < a; ++b)
            CHECK(renderPassName(static_cast<RenderPass>(a)) != renderPassName(static_cast<RenderPass>(b)));
    }
}

TEST_CASE("GPU memory follows what is uploaded, its size and its removal") {
    const auto gl = GlFixture::create();
    NEEDS_GL(gl);
    FrameDescription empty;
    gl->renderer.draw(empty, kCostSize);
    const GpuMemory before = gl->renderer.stats().memory;
    animation::Character painted = makeBiped();
    animation::Texture texture;
    texture.width = 64;
    texture.height = 64;
    texture.rgba.assign(64 * 64 * 4, 200);
    painted.textures.push_back(texture);
    painted.materials[0].baseColorTexture = 0;
    const CharacterHandle handle = gl->upload(painted);
    gl->renderer.draw(empty, {2 * kCostSize.width, 2 * kCostSize.height});
    const GpuMemory with = gl->renderer.stats().memory;
    CHECK(with.textures - before.textures == 64 * 64 * 4 * 4 / 3);
    const long long vertices = 72 * static_cast<long long>(painted.meshes[0].positions.size());
    CHECK(with.meshes - before.meshes == vertices + 4 * static_cast<long long>(painted.meshes[0].indices.size()));
    CHECK(with.targets > before.targets);
    CHECK(with.total() == with.meshes + with.textures + with.targets + with.streams);
    gl->renderer.removeCharacter(handle);
    gl->renderer.draw(empty, kCostSize);
    CHECK(gl->renderer.stats().memory.textures == before.textures);
    CHECK(gl->renderer.stats().memory.meshes == before.meshes);
    CHECK(gl->renderer.stats().memory.targets == before.targets);
}

TEST_CASE("the fast quality shows the same scene with less work") {
    const auto best = GlFixture::create();
    NEEDS_GL(best);
    CrowdToDraw crowd(*best, 3);
    const Image fine = best->picture(crowd.frame, {320, 240});
    const FrameStats work = best->renderer.stats();
    const RendererOptions options = rendererOptions(RenderQuality::fast, best->context);
    const auto fast = GlFixture::create(options);
    REQUIRE(fast);
    CrowdToDraw same(*fast, 3);
    const Image rough = fast->picture(same.frame, {320, 240});
    const ImageDifference difference = compareImages(fine, rough, 24);
    CHECK(difference.differingShare < 0.05);
    CHECK(difference.meanError < 4.0);
    CHECK(difference.maxError > 0);
    CHECK(fast->renderer.stats().drawCalls < work.drawCalls);
    CHECK(fast->renderer.stats().memory.targets < work.memory.targets / 2);
    // Automatic is the one or the other by the driver.
    const RendererOptions chosen = rendererOptions(RenderQuality::automatic, best->context);
    CHECK(chosen.samples == (best->context.isSoftware() ? options.samples : RendererOptions{}.samples));
    CHECK(rendererOptions(RenderQuality::best, best->context).samples == RendererOptions{}.samples);
}
