#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "animation/import/import_character.hpp"
#include "commands.hpp"
#include "interrupt.hpp"
#include "log_text.hpp"
#include "options.hpp"
#include "render/gl/gl_context.hpp"
#include "standard_streams.hpp"

namespace {

constexpr const char* kExitCodes =
    "Exit codes: 0 done; 1 internal failure; 2 wrong usage; 3 the input can't be read or is not usable;\n"
    "4 `check` found errors; 5 an output can't be written; 6 no display or no GL context.";

constexpr const char* kLicenses = "Lutka " LUTKA_VERSION ", MIT\n"
#include "lutka_parts.inc"
    ;

// The program's version and those of the parts that decide what a run gives. OpenGL's is the driver's that a picture
// without a window would be drawn with.
std::string versions() {
    const auto context = lutka::render::GlContext::createHeadless();
    return "lutka " LUTKA_VERSION "\nBullet " LUTKA_BULLET_VERSION ", Assimp " LUTKA_ASSIMP_VERSION "\nOpenGL: " +
           (context ? context.value().description() : std::string("none"));
}

void addCommands(const lutka::cli::Command& app) {
    lutka::cli::addInspect(app);
    lutka::cli::addMap(app);
    lutka::cli::addBuild(app);
    lutka::cli::addCheck(app);
    lutka::cli::addReport(app);
    lutka::cli::addScene(app);
    lutka::cli::addSimulate(app);
    lutka::cli::addRender(app);
    lutka::cli::addRetarget(app);
    lutka::cli::addExport(app);
    lutka::cli::addEdit(app);
    lutka::cli::addBench(app);
    lutka::cli::addBatch(app);
}

// The exit code; whatever was thrown ends here.
int runCommands(int argc, char** argv) {
    try {
        return lutka::cli::parseCommandLine(
            argc, argv,
            {versions, kLicenses, kExitCodes, [] { spdlog::set_level(spdlog::level::err); },
             [] { spdlog::set_level(spdlog::level::debug); }},
            addCommands);
    } catch (const lutka::cli::Exit& exit) {
        return exit.code;
    } catch (const std::system_error& refused) {
        // What fmt throws when stdout can't be written (a full disk, a closed pipe): main() finds that and tells it.
        if (std::ferror(stdout) != 0) return 0;
        spdlog::critical("the system refused: {}", refused.what());
    } catch (const std::bad_alloc&) {
        spdlog::critical("out of memory");
    } catch (const std::exception& unexpected) {
        spdlog::critical("internal failure: {}", unexpected.what());
    }
    return static_cast<int>(lutka::ErrorCode::internal);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 1 && lutka::animation::asksForImport(argv[1]))
        return lutka::animation::serveImport(std::vector<std::string>(argv + 1, argv + argc));
    lutka::cli::openStandardStreams();
    // Facts go to stdout, everything else to stderr, so that `--json` can be piped.
    // Colours only on a terminal, and not where NO_COLOR (https://no-color.org) forbids them.
    const char* noColor = std::getenv("NO_COLOR");
    const bool plain = noColor != nullptr && *noColor != '\0';
    auto sink = std::make_shared<spdlog::sinks::stderr_color_sink_mt>(plain ? spdlog::color_mode::never
                                                                            : spdlog::color_mode::automatic);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("lutka", std::move(sink)));
    spdlog::set_formatter(lutka::cli::logFormatter());
    lutka::cli::installInterruptHandler();
    const int code = runCommands(argc, argv);
    // An error that came before is the more telling one; findings and success mean nothing when nobody could read them.
    const bool told = code == 0 || code == static_cast<int>(lutka::ErrorCode::findings);
    if (lutka::cli::flushStandardOutput() || !told) return code;
    spdlog::error(
        "standard output: can't be written (check that the disk has room and that the pipe's reader is alive)");
    return static_cast<int>(lutka::ErrorCode::output);
}
