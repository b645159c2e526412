#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "export/export_ragdoll.hpp"
#include "options.hpp"
#include "outputs.hpp"

namespace lutka::cli {
namespace {

struct ExportCommandOptions {
    RagdollOptions ragdoll;
    std::filesystem::path out;
    std::string format;  // empty: by the ending of `out`
    bool json = false;
};

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats())
        names.emplace_back(info.name);
    return names;
}

exporting::ExportFormat formatOf(const ExportCommandOptions& options) {
    const auto format =
        options.format.empty() ? exporting::exportFormatOf(options.out) : exporting::exportFormatNamed(options.format);
    if (format) return *format;
    std::vector<std::string_view> endings;
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats())
        if (std::find(endings.begin(), endings.end(), info.ending) == endings.end()) endings.push_back(info.ending);
    leave({ErrorCode::usage, fmt::format("the ending of '{}' names no format", options.out.string()), "--output",
           fmt::format("end the name in one of {}, or add --format", fmt::join(endings, ", "))});
}

std::string factsJson(const ExportCommandOptions& options, exporting::ExportFormat format,
                      const exporting::Exported& exported) {
    nlohmann::ordered_json json;
    json["model"] = options.ragdoll.model.model.string();
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats()) {
        if (info.format == format) json["format"] = info.name;
    }
    json["file"] = options.out.string();
    json["bytes"] = exported.bytes.size();
    json["warnings"] = exported.warnings;
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void runExport(ExportCommandOptions& options) {
    const exporting::ExportFormat format = formatOf(options);
    keepInputs(options.out, {options.ragdoll.model.model, options.ragdoll.profile.value_or("")});
    options.ragdoll.model.textures = format == exporting::ExportFormat::glb || format == exporting::ExportFormat::gltf;
    const auto asset = loadAsset(options.ragdoll);
    printWarnings(*asset);
    const auto exported = orLeave(exporting::exportRagdoll(format, {asset->character, asset->profile, asset->rig}));
    for (const std::string& warning : exported.warnings)
        spdlog::warn("{}", warning);
    orLeave(writeFileAtomically(options.out, exported.bytes));
    if (isStandardOutput(options.out)) return;
    if (options.json) {
        fmt::print("{}", factsJson(options, format, exported));
    } else {
        tell("  wrote {}\n", options.out.string());
    }
}

std::string formatHelp() {
    std::string help = "the format; default: by the ending.";
    for (const exporting::ExportFormatInfo& info : exporting::exportFormats())
        help += fmt::format(" {} ({}): {}.", info.name, info.ending, info.summary);
    return help;
}

}  // namespace

void addExport(const Command& app) {
    auto options = std::make_shared<ExportCommandOptions>();
    const Command command = app.add("export", "Write the ragdoll in another engine's format");
    options->ragdoll.addTo(command);
    command.option("-o,--output", options->out, "the file; its ending chooses the format; - for stdout").required();
    command.option("--format", options->format, formatHelp()).oneOf(formatNames());
    command.flag("--json", options->json, "print what was written, and its warnings, as JSON on stdout");
    command.onRun([options] { runExport(*options); });
}

}  // namespace lutka::cli
