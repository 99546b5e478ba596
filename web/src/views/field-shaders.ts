// GLSL that draws a plate's direction raster, stretched over its page.
import { colourOfBead, toScreen } from './shaders.js';

/** Vertex shader of one rectangle that covers the page. */
export const fieldVertex = `#version 300 es
precision highp float;
uniform vec2 page;
${toScreen}
out vec2 p;
void main() {
  p = page * vec2(gl_VertexID & 1, gl_VertexID >> 1);
  gl_Position = toScreen(p);
}
`;

/** Fragment shader that shows the direction of each texel as a colour, with short strokes along it. */
export const fieldFragment = `#version 300 es
precision highp float;
precision highp usampler2D;
in vec2 p;
uniform vec4 camera;
uniform vec2 page;
uniform usampler2D angles;
uniform usampler2D modes;
uniform sampler2D palette;
out vec4 colour;

ivec2 texelAt(vec2 at) {
  ivec2 size = textureSize(angles, 0);
  return clamp(ivec2(vec2(at.x, page.y - at.y) / page * vec2(size)), ivec2(0), size - 1);
}
float angleAt(vec2 at) { return (float(texelFetch(angles, texelAt(at), 0).r) / 65535.0 - 0.5) * 3.14159265; }

// Places that follow no map: one grey per mode, with rings (parallel), spokes (orthogonal) or nothing (smoothest).
vec3 modeColour(uint mode, vec2 d, float cell) {
  vec3 base = mode == 0u ? vec3(0.80, 0.79, 0.76) : mode == 1u ? vec3(0.62, 0.62, 0.61) : vec3(0.71, 0.72, 0.73);
  float sign = mode == 0u ? abs(length(d) - 0.26 * cell) : min(abs(d.x), abs(d.y)) + max(0.0, length(d) - 0.3 * cell);
  float ink = mode == 2u ? 0.0 : clamp(1.4 - sign * camera.z, 0.0, 1.0);
  return mix(base, vec3(0.25), 0.5 * ink);
}

void main() {
  float angle = angleAt(p);
  vec3 base = texture(palette, vec2(angle / 3.14159265 + 0.5 / 256.0, 0.5)).rgb;
  float cell = 22.0 / camera.z;  // one stroke every so many mm
  vec2 middle = (floor(p / cell) + 0.5) * cell;
  float turn = angleAt(middle);
  vec2 t = vec2(cos(turn), sin(turn));
  vec2 d = p - middle;
  uint mode = texelFetch(modes, texelAt(p), 0).r;
  if (mode != 3u) {
    colour = vec4(modeColour(mode, d, cell), 1.0);
    return;
  }
  float along = clamp(dot(d, t), -0.36 * cell, 0.36 * cell);
  float distance = length(d - t * along) * camera.z;
  float ink = clamp(1.6 - distance, 0.0, 1.0);
  colour = vec4(mix(base, vec3(0.09, 0.09, 0.10), 0.75 * ink), 1.0);
}
`;

/** Fragment shader that shows a plate without beads the way beads along its directions would look. */
export const sheenFragment = `#version 300 es
precision highp float;
precision highp usampler2D;
in vec2 p;
uniform vec4 camera;
uniform usampler2D angles;
uniform sampler2D cover;  // of the page, by the shape
uniform float blended;
uniform float opacity;
out vec4 colour;

${colourOfBead}
// Across the bead there, on the side of like.
vec2 acrossAt(ivec2 texel, vec2 like) {
  ivec2 last = textureSize(angles, 0) - 1;
  float angle = (float(texelFetch(angles, clamp(texel, ivec2(0), last), 0).r) / 65535.0 - 0.5) * 3.14159265;
  vec2 across = vec2(-sin(angle), cos(angle));
  return dot(across, like) < 0.0 ? -across : across;
}
vec2 placeOf(vec2 at) { return vec2(at.x, page.y - at.y) / page * vec2(textureSize(angles, 0)); }

// The place across its bead, -1..1, with the middle at 0. Waves of one length across the directions around are joined where
// they differ (phasor noise; Tricart et al. 2019): straight beads are whole, others begin and end between each other as real
// ones do.
float sideAt(vec2 across) {
  float cell = 3.0 * spacing;
  float turns = 6.2831853 / spacing;
  vec2 wave = 1e-3 * vec2(cos(turns * dot(across, p)), sin(turns * dot(across, p)));
  for (int k = 0; k < 9; ++k) {
    vec2 middle = (floor(p / cell) + vec2(k % 3, k / 3) - 0.5) * cell;
    vec2 there = acrossAt(ivec2(placeOf(middle)), across);
    vec2 off = (p - middle) / cell;
    float phase = turns * dot(there, p);
    wave += exp(-2.5 * dot(off, off)) * smoothstep(0.8, 0.95, dot(there, across)) * vec2(cos(phase), sin(phase));
  }
  return atan(wave.y, wave.x) / 3.14159265;
}

vec3 beadAlong(vec2 across, float side, float relief) {
  return colourOf(p, vec2(across.y, -across.x), side, relief, 0.5 * spacing, -1.0, vec2(-1.0, 0.0));
}

void main() {
  float inside = texture(cover, vec2(p.x, page.y - p.y) / page).r;
  float alpha = opacity * clamp((inside - 0.5) / max(fwidth(inside), 1e-4) + 0.5, 0.0, 1.0);
  if (alpha <= 0.0) discard;
  vec2 place = placeOf(p) - 0.5;
  ivec2 corner = ivec2(floor(place));
  vec2 share = fract(place);
  vec2 across = acrossAt(corner + ivec2(step(0.5, share)), vec2(0.0, 1.0));
  vec2 near[4];
  float weights[4];
  vec2 mean = vec2(0.0);
  float alike = 1.0;
  for (int k = 0; k < 4; ++k) {
    vec2 to = vec2(k & 1, k >> 1);
    near[k] = acrossAt(corner + ivec2(to), across);
    vec2 ways = mix(1.0 - share, share, to);
    weights[k] = ways.x * ways.y;
    mean += weights[k] * near[k];
    alike = min(alike, dot(near[k], across));
  }
  float relief = (1.0 - blended) * clamp((0.5 * spacing * camera.z - 0.75) / 1.5, 0.0, 1.0);
  float side = relief > 0.0 ? sideAt(across) : 0.0;
  vec3 seen = vec3(0.0);
  if (alike > 0.95) seen = beadAlong(normalize(mean), side, relief);
  // Edges of letters and mosaics stay what they are: no direction between two lies there.
  else for (int k = 0; k < 4; ++k) seen += weights[k] * beadAlong(near[k], side, relief);
  colour = vec4(seen, alpha);
}
`;
