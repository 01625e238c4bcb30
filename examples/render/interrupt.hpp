#pragma once

namespace render {

/// From now on Ctrl-C is remembered instead of ending the program; a second one ends it.
void watch_interrupt();

/// True once Ctrl-C has been pressed.
bool interrupted();

}  // namespace render
