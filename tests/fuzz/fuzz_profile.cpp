#include "fuzz/fuzz_target.hpp"
#include "physics/profile/profile_io.hpp"

using namespace lutka;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto profile = physics::profileFromJson(fuzz::textOf(data, size), "fuzz");
    if (!profile) return 0;
    fuzz::promise(physics::validate(profile.value()).empty());
    // What was read is written so that it reads as the same again.
    const std::string text = physics::profileToJson(profile.value());
    const auto again = physics::profileFromJson(text, "again");
    fuzz::promise(again.ok() && physics::profileToJson(again.value()) == text);
    return 0;
}
