// docs/cli.md names every option of every command, and no other.
#include <algorithm>
#include <regex>
#include <set>

#include "support/catch.hpp"
#include "support/command.hpp"

using namespace lutka::test;

namespace {

std::set<std::string> optionsIn(const std::string& text) {
    static const std::regex kOption("--[a-z][a-z-]*[a-z]");
    std::set<std::string> options;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), kOption); match != std::sregex_iterator(); ++match)
        options.insert(match->str());
    return options;
}

// The commands that `lutka --help` lists under a heading that ends its lines' first words.
std::set<std::string> commandsOfHelp() {
    const std::string help = lutkaCommand("--help").out;
    const std::size_t list = help.find("ommands:");
    REQUIRE(list != std::string::npos);
    static const std::regex kCommand("\n  ([a-z]+)  ");
    const std::string text = help.substr(list);
    std::set<std::string> commands;
    for (auto match = std::sregex_iterator(text.begin(), text.end(), kCommand); match != std::sregex_iterator();
         ++match)
        commands.insert((*match)[1]);
    return commands;
}

std::set<std::string> without(const std::set<std::string>& all, const std::set<std::string>& known) {
    std::set<std::string> rest;
    std::set_difference(all.begin(), all.end(), known.begin(), known.end(), std::inserter(rest, rest.begin()));
    return rest;
}

}  // namespace

TEST_CASE("docs/cli.md names each command and option of --help, and no other") {
    const std::string page = fileText(LUTKA_TESTS_DIR "/../docs/cli.md");
    std::set<std::string> offered = optionsIn(lutkaCommand("--help").out);
    const std::set<std::string> commands = commandsOfHelp();
    CHECK(commands.size() >= 9);
    for (const std::string& command : commands) {
        INFO(command);
        CHECK(page.find("| `lutka " + command + " ") != std::string::npos);
        const CommandResult help = lutkaCommand(command + " --help");
        REQUIRE(help.code == 0);
        offered.merge(optionsIn(help.out));
    }
    const std::set<std::string> none;
    CHECK(without(offered, optionsIn(page)) == none);  // not in the page
    CHECK(without(optionsIn(page), offered) == none);  // no option any more
}
