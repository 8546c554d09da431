// The one exception type that the library throws.
#pragma once

#include <stdexcept>
#include <string>

namespace tessera {

// what() is a single line: what was wrong, where (file, object or option), what to do. No trailing newline.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace tessera
