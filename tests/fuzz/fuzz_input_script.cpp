#include "editor/input/input_script.hpp"
#include "fuzz/fuzz_target.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto script = editor::scriptFromText(fuzz::textOf(data, size), "fuzz");
    if (!script) return 0;
    const auto again = editor::scriptFromText(editor::scriptToText(script.value()), "again");
    fuzz::promise(again.ok() && again.value().entries.size() == script.value().entries.size());
    return 0;
}
