#include "report/page.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "core/assert.hpp"
#include "core/files.hpp"

namespace lutka::reporting {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestPart = std::size_t{16} << 20U;
constexpr const char* kThreeMend =
    "install Debian's libjs-three, or name a three.min.js of release 100 to 150 in LUTKA_THREE_JS";
constexpr const char* kDebianThree = "/usr/share/javascript/three/three.min.js";

Result<std::string> textOf(const fs::path& file) {
    const auto bytes = readFile(file, kLargestPart);
    if (!bytes) return bytes.error();
    return std::string(bytes.value().begin(), bytes.value().end());
}

Result<std::string> ownPart(std::string_view name) {
    const auto file = findAsset("report/" + std::string(name));
    if (!file) return file.error();
    return textOf(file.value());
}

Result<fs::path> findThree() {
    if (const char* named = std::getenv("LUTKA_THREE_JS"); named != nullptr && *named != '\0') return fs::path(named);
    if (const auto own = findAsset("report/three.min.js")) return own.value();
    if (std::error_code failed; fs::is_regular_file(kDebianThree, failed)) return fs::path(kDebianThree);
    return Error{ErrorCode::input, "three.js, which draws the report's view, is not there", kDebianThree, kThreeMend};
}

// Later releases are modules only, which a page of one file can't import.
Result<std::string> readThree() {
    const auto file = findThree();
    if (!file) return file.error();
    auto text = textOf(file.value());
    if (!text) return Error{ErrorCode::input, text.error().message, file.value().string(), kThreeMend};
    const std::string_view source = text.value();
    if (source.find("SkinnedMesh") != std::string_view::npos &&
        source.substr(0, 2000).find(".THREE") != std::string_view::npos)
        return text;
    return Error{ErrorCode::input, "is no build of three.js that gives a global THREE", file.value().string(),
                 kThreeMend};
}

}  // namespace

Result<PageParts> loadPageParts(PageKind kind) {
    PageParts parts;
    const std::pair<const char*, std::string*> own[] = {{"model.html", &parts.model},
                                                        {"library.html", &parts.library},
                                                        {"report.css", &parts.style},
                                                        {"model.js", &parts.modelView},
                                                        {"library.js", &parts.libraryView}};
    for (const auto& [name, part] : own) {
        auto text = ownPart(name);
        if (!text) return text.error();
        *part = std::move(text).value();
    }
    if (kind == PageKind::library) return parts;
    auto three = readThree();
    if (!three) return three.error();
    parts.three = std::move(three).value();
    return parts;
}

std::string filled(std::string_view text, std::initializer_list<std::pair<std::string_view, std::string_view>> values) {
    std::string out;
    while (true) {
        const std::size_t open = text.find("{{");
        const std::size_t close = open == std::string_view::npos ? open : text.find("}}", open);
        if (close == std::string_view::npos) return out += text;
        const std::string_view name = text.substr(open + 2, close - open - 2);
        const auto* const found =
            std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == name; });
        LUTKA_ASSERT(found != values.end());
        out += text.substr(0, open);
        if (found != values.end()) out += found->second;
        text.remove_prefix(close + 2);
    }
}

}  // namespace lutka::reporting
