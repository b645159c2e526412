#include "export/export_ragdoll.hpp"

#include <set>

#include "export/doll_source.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka;
using namespace lutka::exporting;
using namespace lutka::test;

TEST_CASE("a format is known by its name and by the ending of the file, in any case of letters") {
    std::set<std::string_view> names;
    for (const ExportFormatInfo& info : exportFormats()) {
        CHECK(names.insert(info.name).second);
        CHECK(exportFormatNamed(info.name) == info.format);
        CHECK(exportFormatOf("a folder/doll" + std::string(info.ending)).has_value());
    }
    CHECK(exportFormatOf("DOLL.XML") == ExportFormat::mjcf);
    CHECK_FALSE(exportFormatOf("doll.txt"));
    CHECK_FALSE(exportFormatOf(".xml"));
    CHECK_FALSE(exportFormatNamed("xml"));
}

TEST_CASE("every format writes the hand-made doll, and has a section in docs/export.md") {
    const DollSource doll;
    const std::string page = fileText(LUTKA_TESTS_DIR "/../docs/export.md");
    for (const ExportFormatInfo& info : exportFormats()) {
        INFO(info.name);
        const auto exported = exportRagdoll(info.format, doll.source());
        REQUIRE(exported);
        CHECK(exported.value().bytes.size() > 1000);
        CHECK(exported.value().bytes.find("nan") == std::string::npos);
        CHECK(page.find("`" + std::string(info.name) + "`") != std::string::npos);
    }
}
