// Runs what may crash or hang on damaged input in a process of its own first.
#pragma once

#include <functional>
#include <string>

namespace tessera {

// Runs `work` in a forked process, whose output is thrown away and whose processor time is limited. Returns what it died of, in words
// for a message ("it crashed (signal 11)", "it took more than 60 seconds"); empty when it came to its end, be it by an exception, or when
// no process could be made. What `work` did leaves no trace: to have its result, run it again.
[[nodiscard]] std::string trialRun(const std::function<void()>& work, unsigned seconds);

}  // namespace tessera
