// The claims that README.md makes of the processes, each a comparison that can fail.
#pragma once

#include "options.h"

bool checks(const Command& command);
