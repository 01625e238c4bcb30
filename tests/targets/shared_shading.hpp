#pragma once

/// The radiance of one point under some lights.
float shared_shading();
