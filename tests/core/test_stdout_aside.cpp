#include <cstdio>
#include <iostream>

#include "core/stdout_aside.hpp"
#include "support/catch.hpp"
#include "support/command.hpp"
#include "support/other_streams.hpp"

using namespace lutka;
using test::fileText;
using test::OtherStreams;

TEST_CASE("what is printed meanwhile goes to standard error, whichever way it is printed") {
    const test::ScratchFolder folder;
    {
        const OtherStreams streams(folder / "out", folder / "err");
        std::printf("before\n");  // in a buffer yet
        {
            const StdoutAside aside;
            std::printf("by stdio\n");
            std::cout << "by a stream\n";
        }
        std::printf("after\n");
    }
    CHECK(fileText(folder / "out") == "before\nafter\n");
    CHECK(fileText(folder / "err") == "by stdio\nby a stream\n");
}

TEST_CASE("what standard error can't take is no failure of standard output and never gets there") {
    const test::ScratchFolder folder;
    for (const char* err : {"", "/dev/full"}) {
        INFO("standard error: " << (*err == '\0' ? "closed" : err));
        const std::string out = folder / (*err == '\0' ? "closed" : "full");
        bool failed = true;
        {
            const OtherStreams streams(out, err);
            {
                const StdoutAside aside;
                std::printf("chatter\n");
            }
            std::printf("ours\n");
            failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
        }
        CHECK_FALSE(failed);
        CHECK(fileText(out) == "ours\n");
    }
}

TEST_CASE("a standard output that failed before has failed afterwards") {
    bool failed = false;
    {
        const OtherStreams streams("/dev/full");
        std::printf("lost\n");
        std::fflush(stdout);
        { const StdoutAside aside; }
        failed = std::ferror(stdout) != 0;
        std::clearerr(stdout);
    }
    CHECK(failed);
}
