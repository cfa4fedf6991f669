// The teaching modes by their names: each is {enter(studio), leave(studio)}.
"use strict";

const studioModes = {};
