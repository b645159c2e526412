#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <exception>
#include <memory>

#include "commands.hpp"
#include "console.hpp"
#include "core/files.hpp"
#include "interrupt.hpp"
#include "options.hpp"
#include "outputs.hpp"
#include "report/library_report.hpp"
#include "report/model_report.hpp"
#include "report/page.hpp"
#include "report/pictures.hpp"

namespace lutka::cli {
namespace {

namespace fs = std::filesystem;

struct ReportCommandOptions {
    RagdollOptions ragdoll;
    fs::path out;
    bool pictures = true;
    bool json = false;
};

// Null, with a word, where there is no GL: a report without pictures is still one.
std::unique_ptr<reporting::Photographer> photographerOf(const ReportCommandOptions& options) {
    if (!options.pictures) return nullptr;
    auto photographer = reporting::Photographer::create();
    if (photographer) return std::move(photographer).value();
    spdlog::warn("{}; the report has no pictures", photographer.error().text());
    return nullptr;
}

// What is told when the document does not go to stdout itself.
void finish(const ReportCommandOptions& options, const std::string& html, const std::string& json,
            const std::string& summary) {
    orLeave(writeFileAtomically(options.out, html));
    if (isStandardOutput(options.out)) return;
    if (options.json) {
        fmt::print("{}", json);
        return;
    }
    tell("{}\n  wrote {}\n", summary, options.out.string());
}

void reportModel(const ReportCommandOptions& options) {
    const auto parts = orLeave(reporting::loadPageParts(reporting::PageKind::model));
    const auto asset = loadAsset(options.ragdoll);
    printWarnings(*asset);
    const auto photographer = photographerOf(options);
    const reporting::ModelFacts facts = reporting::gatherFacts(*asset, photographer.get());
    const std::size_t findings = facts.checkup.diagnosis.findings.size();
    finish(options, reporting::modelReportHtml(*asset, facts, parts, LUTKA_VERSION),
           scene::checkupJson(*asset, facts.checkup),
           fmt::format("{}: {:.0f} of 100, {} finding{}", asset->character.name, facts.checkup.score, findings,
                       findings == 1 ? "" : "s"));
}

// What a model throws is its own affair: the others go on.
Result<reporting::LibraryRow> examineOne(const ReportCommandOptions& options, const fs::path& file,
                                         const std::string& name, reporting::Photographer* photographer) {
    try {
        const auto asset = scene::loadRagdoll(file, options.ragdoll.load());
        if (!asset) return asset.error();
        auto row = reporting::libraryRow(name, *asset.value(), scene::examineFalls(*asset.value()));
        if (photographer != nullptr) row.thumbnail = photographer->thumbnail(*asset.value());
        return row;
    } catch (const std::exception& unexpected) {
        return Error{ErrorCode::internal, fmt::format("internal failure: {}", unexpected.what()), file.string(),
                     "please report the model"};
    }
}

void reportLibrary(const ReportCommandOptions& options) {
    const fs::path& folder = options.ragdoll.model.model;
    if (options.ragdoll.profile) {
        leave({ErrorCode::usage, "a profile goes with one model, and this is a folder", folder.string(),
               "leave --profile out, or name a model"});
    }
    const auto parts = orLeave(reporting::loadPageParts(reporting::PageKind::library));
    const std::vector<fs::path> models = orLeave(reporting::modelsBelow(folder));
    const auto photographer = photographerOf(options);
    reporting::Library library;
    library.folder = folder.string();
    Progress progress("examining", static_cast<int>(models.size()));
    for (std::size_t i = 0; i < models.size(); ++i) {
        leaveIfInterrupted();
        const std::string name = models[i].lexically_relative(folder).string();
        auto row = examineOne(options, models[i], name, photographer.get());
        if (row)
            library.rows.push_back(std::move(row).value());
        else
            library.refused.push_back({name, row.error()});
        progress.at(static_cast<int>(i) + 1);
    }
    reporting::sortLibrary(library);
    finish(
        options, reporting::libraryReportHtml(library, parts, LUTKA_VERSION), reporting::libraryReportJson(library),
        fmt::format("{} models: {} examined, {} refused", models.size(), library.rows.size(), library.refused.size()));
}

void runReport(ReportCommandOptions& options) {
    checkEnding("--output", options.out, {".html", ".htm"});
    options.ragdoll.model.textures = true;
    std::error_code failed;
    fs::is_directory(options.ragdoll.model.model, failed) ? reportLibrary(options) : reportModel(options);
}

}  // namespace

void addReport(const Command& app) {
    auto options = std::make_shared<ReportCommandOptions>();
    const Command command =
        app.add("report", "Write a page for browsers: score, findings, charts and the falling doll");
    options->ragdoll.addTo(command);
    command.find("MODEL").describe("rigged character, or a folder: one table of all models below it");
    command.option("-o,--output", options->out, "the page (.html), all in one file; - for stdout").required();
    command.flag("!--no-pictures", options->pictures, "leave the pictures out");
    command.flag("--json", options->json, "print the facts as JSON on stdout");
    command.onRun([options] { runReport(*options); });
}

}  // namespace lutka::cli
