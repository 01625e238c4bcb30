#pragma once

namespace render {

/// Exit status of a program that a signal ended.
inline constexpr int interrupted_status = 3;

/// From now on SIGINT, SIGTERM and SIGHUP end `program` at once, with that status, a line on stderr and no temporary
/// file left. A signal that the parent has set to be ignored stays ignored. `program`: a literal.
void watch_signals(const char* program);

/// From now on the first of these signals is only remembered, for what is finished to be saved; a second one ends the
/// program as above.
void defer_signals();

/// True once there has been a signal since `defer_signals`.
bool interrupted();

}  // namespace render
