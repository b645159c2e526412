#pragma once

/// A header of the host's own, in a folder and with a name that the library has too.
struct OwnResult {
    int code = 0;
};
