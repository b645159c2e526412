#include "editor/application.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

#include "editor/files/model_pictures.hpp"
#include "editor/input/window_input.hpp"
#include "editor/ui/editor_ui.hpp"
#include "editor/ui/frame_history.hpp"
#include "editor/ui/imgui_host.hpp"
#include "editor/ui/ui_scale.hpp"
#include "editor/ui/user_settings.hpp"
#include "editor/view/quality_governor.hpp"
#include "render/environment.hpp"
#include "render/gl/renderer.hpp"
#include "scene/draw/scene_extent.hpp"

namespace lutka::editor {
namespace {

constexpr double kFixedFrame = 1.0 / 60.0;
using Clock = std::chrono::steady_clock;

/// Everything that lives while the editor runs, in the order of making; the GL context goes last.
class Application {
  public:
    Application(const ApplicationOptions& options, render::GlContext context)
        : options_(options), context_(std::move(context)) {}

    Result<void> start();
    Result<void> run();

  private:
    [[nodiscard]] bool scripted() const { return options_.input.has_value(); }
    /// Frames of one length and steps that nobody times, so that the same input gives the same simulation.
    [[nodiscard]] bool fixedFrames() const { return scripted() || options_.headless || !options_.recordInput.empty(); }
    [[nodiscard]] int frameLimit() const;
    void collectEvents();
    void takeInput(std::span<const InputEvent> events, double seconds);
    Result<void> record();
    Result<void> followCharacter();
    Result<void> oneFrame(double seconds);
    Result<void> drawPicture();
    void followSky();
    void keepModelPicture();
    void rememberSettings();
    void rememberFile(const std::filesystem::path& file);
    void followScene();
    [[nodiscard]] bool isSeen() const;
    Result<void> takeScreenshots();
    void updateTitle();
    [[nodiscard]] double nextFrameSeconds();

    const ApplicationOptions& options_;
    render::GlContext context_;
    std::optional<render::Renderer> renderer_;
    std::unique_ptr<WindowInput> window_;
    std::unique_ptr<ImguiHost> host_;
    std::unique_ptr<EditorUi> ui_;
    std::unique_ptr<Editor> editor_;
    std::optional<ScriptPlayer> script_;
    std::optional<ScriptWriter> recorder_;
    UserSettings settings_;

    std::vector<const scene::RagdollAsset*> uploaded_;  // whose characters `characters_` are
    std::vector<render::CharacterHandle> characters_;
    int characterRevision_ = -1;
    QualityGovernor governor_;
    std::filesystem::path scene_;  // the file of the scene that was remembered last
    std::filesystem::path sky_;    // whose light the renderer has
    bool vsync_ = true;
    int pictured_ = -1;  // the revision of the character whose picture was kept
    int framesOfModel_ = 0;
    bool allowsOutside_ = false;  // as the editor had it in the last frame
    render::FrameDescription frame_;
    FrameHistory history_;
    std::vector<InputEvent> events_;
    render::Extent windowSize_;
    render::Extent pixels_;
    int frameIndex_ = 0;
    Clock::time_point lastFrame_ = Clock::now();
    std::string title_;
};

MonitorMeasures measuresOf(GLFWwindow* window) {
    MonitorMeasures measures;
    float x = 1.0F;
    float y = 1.0F;
    glfwGetWindowContentScale(window, &x, &y);
    measures.contentScale = std::max(x, y);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return measures;
    if (const GLFWvidmode* mode = glfwGetVideoMode(monitor); mode != nullptr) measures.heightPixels = mode->height;
    int width = 0;
    int height = 0;
    glfwGetMonitorPhysicalSize(monitor, &width, &height);
    measures.heightMm = static_cast<float>(height);
    return measures;
}

// What the monitor wants, less what the window system does already by giving a window more pixels than its size.
float monitorScale(const render::GlContext& context) {
    GLFWwindow* window = context.window();
    if (window == nullptr) return 1.0F;
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window, &width, &height);
    const float done =
        width > 0 ? static_cast<float>(context.framebufferSize().width) / static_cast<float>(width) : 1.0F;
    return std::max(uiScaleFor(measuresOf(window)) / std::max(done, 1.0F), 0.75F);
}

render::Extent shareOf(render::Extent pixels, float share) {
    const auto part = [&](int length) { return std::max(static_cast<int>(static_cast<float>(length) * share), 1); };
    return {part(pixels.width), part(pixels.height)};
}

// A window that was not asked for by its size has room for its panels.
render::Extent widened(GLFWwindow* window, render::Extent usual, float scale) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) return usual;
    int x = 0;
    int y = 0;
    render::Extent free;
    glfwGetMonitorWorkarea(monitor, &x, &y, &free.width, &free.height);
    const render::Extent size = windowSizeFor(usual, scale, free);
    if (size.width != usual.width || size.height != usual.height) glfwSetWindowSize(window, size.width, size.height);
    return size;
}

Result<void> Application::start() {
    windowSize_ = options_.input ? options_.input->size : options_.editor.window;
    const auto quality = options_.headless ? render::RenderQuality::best : options_.quality;
    auto renderer = render::Renderer::create(context_, render::rendererOptions(quality, context_));
    if (!renderer) return renderer.error();
    renderer_.emplace(std::move(renderer).value());
    if (options_.settings) settings_ = loadUserSettings(userSettingsFile());
    const float chosen = options_.uiScale > 0.0F ? options_.uiScale : settings_.uiScale;
    const float scale = chosen > 0.0F ? chosen : monitorScale(context_);
    host_ = std::make_unique<ImguiHost>(scale);
    if (context_.window() != nullptr) {
        if (options_.windowFollowsScale) windowSize_ = widened(context_.window(), windowSize_, scale);
        window_ = std::make_unique<WindowInput>(context_.window());
        host_->useClipboard([window = context_.window()] { return glfwGetClipboardString(window); },
                            [window = context_.window()](const char* text) { glfwSetClipboardString(window, text); });
    }
    ui_ = std::make_unique<EditorUi>(*host_);
    ui_->state.amendStats = options_.amendStats;
    EditorOptions editor = options_.editor;
    editor.window = windowSize_;
    ui_->state.leftWidth = settings_.leftWidth;
    ui_->state.rightWidth = settings_.rightWidth;
    ui_->state.bottomHeight = settings_.bottomHeight;
    ui_->state.tabSides = settings_.tabSides;
    if (options_.settings) ui_->state.pictureFolder = modelPictureFolder();
    ui_->state.uiScale = settings_.uiScale;
    editor.load.import.allowOutside = editor.load.import.allowOutside || settings_.allowOutside;
    allowsOutside_ = editor.load.import.allowOutside;
    editor.recovery = options_.recovery;
    if (!fixedFrames()) editor.clock = scene::steadyClock();
    auto made = Editor::create(editor);
    if (!made) return made.error();
    editor_ = std::move(made).value();
    editor_->workspace().uiScale = scale;
    editor_->view.vsync = vsync_ = options_.vsync;
    if (options_.input) script_.emplace(*options_.input);
    if (!options_.recordInput.empty()) {
        auto recorder = ScriptWriter::create(options_.recordInput, windowSize_);
        if (!recorder) return recorder.error();
        recorder_.emplace(std::move(recorder).value());
    }
    if (auto followed = followCharacter(); !followed) return followed;
    followScene();
    return {};
}

int Application::frameLimit() const {
    if (options_.frames) return *options_.frames;
    int last = options_.input ? options_.input->lastFrame() : -1;
    for (const ApplicationOptions::Screenshot& one : options_.screenshots)
        last = std::max(last, one.frame);
    // A window stays open for its user, unless it only plays a script or takes pictures.
    return last >= 0 ? last + 1 : std::numeric_limits<int>::max();
}

void Application::collectEvents() {
    events_.clear();
    if (window_) {
        window_->poll(events_);
        glfwGetWindowSize(context_.window(), &windowSize_.width, &windowSize_.height);
        // A script is the only user, but its window can still be closed.
        if (scripted()) {
            std::erase_if(events_, [](const InputEvent& event) { return event.kind != InputEvent::Kind::close; });
        }
    }
    if (script_) {
        for (const InputScript::Entry& entry : script_->take(frameIndex_))
            events_.push_back(entry.event);
    }
    for (const InputEvent& event : events_) {
        if (event.kind == InputEvent::Kind::resize) {
            windowSize_ = event.size;
            if (window_ && scripted()) glfwSetWindowSize(context_.window(), event.size.width, event.size.height);
        }
    }
    pixels_ = window_ ? context_.framebufferSize() : windowSize_;
}

Result<void> Application::record() {
    if (!recorder_) return {};
    std::vector<InputScript::Entry> entries;
    for (const InputEvent& event : events_)
        entries.push_back({frameIndex_, event});
    return recorder_->add(entries);
}

Result<void> Application::followCharacter() {
    const std::vector<const scene::RagdollAsset*> wanted = editor_->document().sceneDocument().assets();
    const bool sameModel = characterRevision_ == editor_->characterRevision();
    if (sameModel && wanted == uploaded_) return {};
    for (const render::CharacterHandle old : characters_)
        renderer_->removeCharacter(old);
    characters_.clear();
    uploaded_.clear();
    for (const scene::RagdollAsset* asset : wanted) {
        auto uploaded = renderer_->uploadCharacter(asset->character);
        if (!uploaded) return uploaded.error();
        characters_.push_back(uploaded.value());
    }
    uploaded_ = wanted;
    if (sameModel) return {};
    characterRevision_ = editor_->characterRevision();
    rememberFile(editor_->document().character().file);
    return {};
}

void Application::rememberFile(const std::filesystem::path& file) {
    settings_.remember(file);
    if (options_.settings) saveUserSettings(userSettingsFile(), settings_);
    ui_->state.recent = settings_.recent;
}

void Application::followScene() {
    const SceneDocument& document = editor_->document().sceneDocument();
    if (!document.hasFile() || document.file() == scene_) return;
    scene_ = document.file();
    rememberFile(scene_);
}

// What the command line allowed is for this run; what the user chose stays.
void Application::rememberSettings() {
    const UiState& ui = ui_->state;
    if (ui.uiScale != settings_.uiScale) {
        host_->setScale(ui.uiScale > 0.0F ? ui.uiScale : monitorScale(context_), ui.lightTheme);
        editor_->workspace().uiScale = host_->scale();
    }
    const bool outside = editor_->allowsOutside() != allowsOutside_;
    const bool dragged = ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool wider = !dragged && (ui.leftWidth != settings_.leftWidth || ui.rightWidth != settings_.rightWidth ||
                                    ui.bottomHeight != settings_.bottomHeight || ui.tabSides != settings_.tabSides);
    if (!outside && !wider && ui.uiScale == settings_.uiScale) return;
    if (outside) allowsOutside_ = settings_.allowOutside = editor_->allowsOutside();
    settings_.leftWidth = ui.leftWidth;
    settings_.rightWidth = ui.rightWidth;
    settings_.bottomHeight = ui.bottomHeight;
    settings_.tabSides = ui.tabSides;
    settings_.uiScale = ui.uiScale;
    if (options_.settings) saveUserSettings(userSettingsFile(), settings_);
}

void Application::takeInput(std::span<const InputEvent> events, double seconds) {
    const bool pressed = std::any_of(events.begin(), events.end(), [](const InputEvent& event) {
        return event.kind == InputEvent::Kind::mouseButton && event.pressed;
    });
    for (const InputEvent& event : events)
        host_->feed(event);
    host_->beginFrame(windowSize_, pixels_, seconds);
    // A press beside a field ends it: it takes its text before the press changes what the panels show.
    if (pressed && host_->writing()) {
        ui_->build(*editor_, history_);
        host_->skipDrawing();
        host_->beginFrame(windowSize_, pixels_, 0.0);
    }
    editor_->handle(windowResized(windowSize_), {});
    const UiCapture capture = host_->capture();
    for (const InputEvent& event : events)
        editor_->handle(event, capture);
    ui_->build(*editor_, history_);
}

Result<void> Application::oneFrame(double seconds) {
    collectEvents();
    if (auto recorded = record(); !recorded) return recorded;
    if (pixels_.width <= 0 || pixels_.height <= 0) {  // minimised
        for (const InputEvent& event : events_)
            if (event.kind == InputEvent::Kind::close) editor_->handle(event, {});
        if (window_) glfwWaitEventsTimeout(0.05);
        return {};
    }
    // One press, release or key at a time, each with panels that know what the one before did: on a machine that draws
    // twice a second nothing is lost or taken for something else. Only the last is drawn.
    const std::vector<std::span<const InputEvent>> steps = inputSteps(events_);
    for (const std::span<const InputEvent> step : steps) {
        const bool last = step.data() == steps.back().data();
        takeInput(step, last ? seconds : 0.0);
        if (!last) host_->skipDrawing();
    }
    if (editor_->view.vsync != vsync_) context_.setVsync(vsync_ = editor_->view.vsync);
    editor_->update(seconds);
    if (auto followed = followCharacter(); !followed) return followed;
    followScene();
    rememberSettings();
    followSky();
    editor_->describe(characters_, frame_);
    if (!isSeen()) {
        host_->skipDrawing();
        return {};
    }
    if (context_.lost()) {
        editor_->keepRecovery();
        return render::GlContext::lostError();
    }
    return drawPicture();
}

// Scripts and pictures to keep have the quality that was asked for; only a user waits for a slow machine.
Result<void> Application::drawPicture() {
    const auto begun = Clock::now();
    const bool governed = window_ && !fixedFrames() && options_.quality == render::RenderQuality::automatic;
    const PictureQuality quality = governed ? governor_.quality() : PictureQuality{};
    const bool coarse = quality.share < 1.0F && options_.screenshots.empty();
    frame_.ambientOcclusion = quality.ambientOcclusion;
    frame_.lineWidth = std::max(render::FrameDescription().lineWidth * (coarse ? quality.share : 1.0F), 1.0F);
    history_.pictureShare = coarse ? quality.share : 1.0F;
    renderer_->draw(frame_, coarse ? shareOf(pixels_, quality.share) : pixels_);
    history_.stats = renderer_->stats();
    keepModelPicture();
    // Panels are drawn over the coarse picture as sharp as ever.
    coarse ? renderer_->present(pixels_) : renderer_->bindResolvedTarget();
    host_->draw();
    if (auto taken = takeScreenshots(); !taken) return taken;
    if (!window_) return {};
    if (!coarse) renderer_->present(pixels_);
    context_.swapBuffers();
    updateTitle();
    if (governed) governor_.update(std::chrono::duration<double>(Clock::now() - begun).count());
    return {};
}

// Of a model that has just come into the view, for the gallery; before panels are drawn over it, and before it lies.
void Application::keepModelPicture() {
    constexpr int moment = 4;
    if (!options_.settings || pictured_ == characterRevision_ || ++framesOfModel_ < moment) return;
    pictured_ = characterRevision_;
    framesOfModel_ = 0;
    constexpr render::Extent size{320, 200};
    const std::filesystem::path& folder = ui_->state.pictureFolder;
    if (folder.empty()) return;
    const auto file = modelPictureFile(folder, editor_->document().character().file);
    std::vector<vec3> figure;
    scene::Simulation& simulation = editor_->player().simulation();
    if (simulation.dollCount() > 0) scene::addExtentOfDoll(simulation, 0, 1.0F, figure);
    const Workspace& seen = editor_->workspace();
    const auto picture = smallPicture(renderer_->readPixels(), insetsAround(figure, seen.camera, seen.window), size);
    std::error_code failed;
    std::filesystem::create_directories(folder, failed);
    // A model without a picture is no loss.
    if (const auto saved = render::savePng(picture, file); !saved) spdlog::warn("{}", saved.error().text());
    ui_->state.pictures.forget(file);
}

// The panorama that the view wants; one that can't be read is told, and the light stays as it was.
void Application::followSky() {
    if (editor_->view.sky != sky_) {
        const std::filesystem::path wanted = editor_->view.sky;
        if (wanted.empty()) {
            renderer_->setEnvironment(nullptr);
            sky_.clear();
        } else if (const auto sky = render::loadHdr(wanted); sky) {
            renderer_->setEnvironment(&sky.value());
            sky_ = wanted;
        } else {
            editor_->workspace().say(Toast::Kind::error, sky.error().text());
            editor_->view.sky = sky_;
        }
    }
    frame_.sky.environment = !sky_.empty();
    frame_.sky.environmentBackground = frame_.sky.environment && editor_->view.skyBackground;
}

// Without a window only the pictures that are kept are seen, and the one before each: its cost is in their panels.
bool Application::isSeen() const {
    return window_ || std::any_of(options_.screenshots.begin(), options_.screenshots.end(), [&](const auto& one) {
               return one.frame == frameIndex_ || one.frame == frameIndex_ + 1;
           });
}

Result<void> Application::takeScreenshots() {
    for (const ApplicationOptions::Screenshot& one : options_.screenshots) {
        if (one.frame != frameIndex_) continue;
        if (auto saved = render::savePng(renderer_->readPixels(), one.file); !saved) return saved;
    }
    return {};
}

void Application::updateTitle() {
    const EditorDocument& document = editor_->document();
    std::string title = fmt::format("{}{} - Lutka", document.unsaved() ? "● " : "", document.character().name);
    if (title == title_) return;
    title_ = std::move(title);
    glfwSetWindowTitle(context_.window(), title_.c_str());
}

// A script's frames last 1/60 s each, whatever the machine needs: the same input gives the same simulation.
double Application::nextFrameSeconds() {
    const auto now = Clock::now();
    const double seconds = std::chrono::duration<double>(now - lastFrame_).count();
    lastFrame_ = now;
    history_.add(static_cast<float>(seconds * 1000.0));
    return fixedFrames() ? kFixedFrame : seconds;
}

Result<void> Application::run() {
    const int limit = frameLimit();
    lastFrame_ = Clock::now();
    const auto interrupted = [this] { return options_.interrupted && options_.interrupted(); };
    while (frameIndex_ < limit && !editor_->quitting() && !interrupted()) {
        if (auto drawn = oneFrame(nextFrameSeconds()); !drawn) return drawn;
        ++frameIndex_;
    }
    if (interrupted()) editor_->keepRecovery();
    return {};
}

}  // namespace

Result<void> runApplication(const ApplicationOptions& options) {
    if (options.headless && !options.frames && !options.input && options.screenshots.empty()) {
        return Error{ErrorCode::usage, "without a window nobody would ever end the editor", "--headless",
                     "add --frames, --input or --screenshot-at"};
    }
    const render::Extent size = options.input ? options.input->size : options.editor.window;
    auto context = options.headless ? render::GlContext::createHeadless()
                                    : render::GlContext::createWindow({"Lutka", size, true, options.vsync});
    if (!context) return context.error();
    Application application(options, std::move(context).value());
    if (auto started = application.start(); !started) return started;
    return application.run();
}

}  // namespace lutka::editor
