#include "export/export_ragdoll.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "export/write_mjcf.hpp"

namespace lutka::exporting {
namespace {

constexpr std::array kFormats{
    ExportFormatInfo{ExportFormat::mjcf, "mjcf", ".xml", "MuJoCo (Isaac and Newton import it)"},
};

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
    return text;
}

bool endsWith(const std::string& text, std::string_view ending) {
    return text.size() > ending.size() && text.compare(text.size() - ending.size(), ending.size(), ending) == 0;
}

}  // namespace

std::span<const ExportFormatInfo> exportFormats() {
    return kFormats;
}

std::optional<ExportFormat> exportFormatNamed(std::string_view name) {
    for (const ExportFormatInfo& info : kFormats)
        if (info.name == name) return info.format;
    return std::nullopt;
}

std::optional<ExportFormat> exportFormatOf(const std::filesystem::path& file) {
    const std::string name = lower(file.filename().string());
    for (const ExportFormatInfo& info : kFormats)
        if (endsWith(name, info.ending)) return info.format;
    return std::nullopt;
}

Result<Exported> exportRagdoll(ExportFormat format, const ExportSource& source) {
    switch (format) {
        case ExportFormat::mjcf:
            return writeMjcf(source);
    }
    return Error{ErrorCode::internal, "there is no writer for this format", "", ""};
}

}  // namespace lutka::exporting
