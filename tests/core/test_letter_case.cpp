#include "core/letter_case.hpp"

#include "support/catch.hpp"

#include <clocale>
#include <string>

using namespace lutka;

TEST_CASE("letters are made small in ASCII only, in any locale") {
    const std::string before = std::setlocale(LC_ALL, nullptr);
    for (const char* locale : {"C", "C.UTF-8", ""}) {
        if (std::setlocale(LC_ALL, locale) == nullptr) continue;
        CHECK(lowerCased("Left_UPPER-Arm.09[Z]@`") == "left_upper-arm.09[z]@`");
        CHECK(lowerCased("\xC3\x84rmel \xC9") == "\xC3\x84rmel \xC9");
        CHECK(lowerCased('Z') == 'z');
    }
    std::setlocale(LC_ALL, before.c_str());
    CHECK(lowerCased("").empty());
}

TEST_CASE("texts that differ in case only are the same, others are not") {
    CHECK(sameButCase("Hips", "hIPS"));
    CHECK(sameButCase("", ""));
    CHECK_FALSE(sameButCase("Hips", "Hip"));
    CHECK_FALSE(sameButCase("Hip", "Hips"));
    CHECK_FALSE(sameButCase("[", "{"));  // they differ by the bit that tells small letters from great ones
}
