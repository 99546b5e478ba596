// GLSL of the views. Lengths are in mm, y up; `camera` is the middle of the screen and the device pixels per mm.
import { appearance } from '../model/appearance.js';
import { mostDelay } from '../model/view.js';

/** Maps millimetres of the page to clip space. */
export const toScreen = `
uniform vec4 camera;
uniform vec2 screen;
vec4 toScreen(vec2 p) { return vec4((p - camera.xy) * camera.z * 2.0 / screen, 0.0, 1.0); }
`;

/** Draws one segment of a path as a capsule of two triangles. Its two points, and those before and after for a
 * smooth tangent, are read from a texture: instances of four corners each would cost one draw call per segment
 * where there is no graphics card. */
export const beadVertex = `#version 300 es
precision highp float;
uniform highp sampler2D points;  // x, y, width, share of the print
uniform highp sampler2D delays;  // how late neighbours are laid [s], and how the bead leans; one texel: not known
uniform int first;               // point before the first segment
uniform float progress;
${toScreen}
out vec2 p;
flat out vec4 ends;      // a, b
flat out vec4 tangents;  // at a, at b
flat out vec2 radii;
flat out float order;
flat out vec2 delay;

vec2 direction(vec2 v) { float l = length(v); return l > 0.0 ? v / l : vec2(1.0, 0.0); }

// Where two pieces meet: the mean of both directions, so that curves look round, and how far each of them must reach beyond
// the joint for no gap to open. At sharp turns a piece keeps its own direction and goes round its end.
vec3 joint(vec2 own, vec2 other, float reach) {
  if (dot(own, other) <= 0.5) return vec3(own, reach);
  vec2 mean = direction(own + other);
  return vec3(mean, reach * abs(own.x * mean.y - own.y * mean.x) / dot(own, mean) + 0.25 / camera.z);
}

vec4 point(int k) {
  int columns = textureSize(points, 0).x;
  return texelFetch(points, ivec2(k % columns, k / columns), 0);
}

vec2 delayAt(int k) {
  ivec2 size = textureSize(delays, 0);
  return size.y * size.x == 1 ? vec2(0.0) : texelFetch(delays, ivec2(k % size.x, k / size.x), 0).rg;
}

void main() {
  int segment = first + gl_VertexID / 4;
  vec4 before = point(segment), a = point(segment + 1), b = point(segment + 2), after = point(segment + 3);
  vec2 along = direction(b.xy - a.xy);
  ends = vec4(a.xy, b.xy);
  radii = 0.5 * vec2(a.z, b.z);
  order = a.w;
  delay = delayAt(segment + 1);
  float reach = max(radii.x, radii.y) + 1.0 / camera.z;
  vec3 atA = joint(along, direction(a.xy - before.xy), reach);
  vec3 atB = joint(along, direction(after.xy - b.xy), reach);
  tangents = vec4(atA.xy, atB.xy);
  if (b.w >= progress) atB.z = reach;  // the last that is shown
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1 & 1) * 2.0 - 1.0;
  p = (corner.x < 0.0 ? a.xy - along * atA.z : b.xy + along * atB.z) + vec2(-along.y, along.x) * corner.y * reach;
  gl_Position = a.w >= progress && progress < 1.0 ? vec4(2.0, 2.0, 2.0, 1.0) : toScreen(p);
}
`;

/** Light that the round top of a bead sends to an eye straight above, by the core's model and constants
 * (core/src/look/appearance.cpp). It uses scalars alone, so that a test can run it in JavaScript. `middle` and
 * `reach` are the part of the top in view, in half widths; parts too fine to be seen count as their mean. */
export const highlightOfBead = `
float highlightOf(float tiltAlong, float tiltAcross, float alongVariance, float acrossVariance, float middle, float reach) {
  float sum = 0.0;
  for (int k = 0; k < 8; ++k) {
    float across = tiltAcross - ${appearance.profileSlope.toFixed(4)} * (middle + reach * ((float(k) + 0.5) / 4.0 - 1.0));
    sum += exp(-tiltAlong * tiltAlong / (2.0 * alongVariance) - across * across / (2.0 * acrossVariance));
    if (reach == 0.0) return sum;
  }
  return sum / 8.0;
}
`;

/** Look of a bead, as the native preview draws it (core/src/look/preview.cpp); `setLook` sets its uniforms. */
export const lookOfBead = `
uniform vec3 lamp;
uniform vec3 body;
uniform vec3 surface;   // variances along and across, light of the brightest direction
uniform float eyeNear;  // 1: some page widths above the plate; 0: so far away that it sees all of it from straight above
uniform vec2 page;

const float kDiffuse = ${appearance.diffuse.toFixed(4)};
${highlightOfBead}
vec3 encoded(vec3 c) { return mix(1.055 * pow(max(c, 0.0031308), vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThan(c, vec3(0.0031308))); }
// As it is up to 0.8, with a soft shoulder above.
vec3 toned(vec3 c) {
  vec3 over = max(c - 0.8, 0.0);
  return encoded(clamp(min(c, 0.8) + 0.2 * over / (0.2 + over), 0.0, 1.0));
}
float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

vec3 look(vec2 p, vec2 along, float side, float relief) {
  vec2 eye = eyeNear * (0.5 * page - p) / (2.4 * max(page.x, page.y));
  float eyeSize = inversesqrt(dot(eye, eye) + 1.0);
  vec2 tilt = (lamp.xy + eye * eyeSize) / (lamp.z + eyeSize);
  float highlight = highlightOf(dot(tilt, along), along.x * tilt.y - along.y * tilt.x, surface.x, surface.y,
                                side * relief, 1.0 - relief) / surface.z;
  vec3 lit = mix(vec3(1.0), body, 0.85) * vec3(1.0, 0.97, 0.92);
  lit *= 0.88 / max(lit.r, max(lit.g, lit.b));
  vec3 diffuse = body * (luminance(lit) / max(luminance(body), 1e-4));
  float open = 1.0 - relief * 0.5 * side * side * side * side;  // furrows see less of the room
  return (lit * ((1.0 - kDiffuse) * highlight) + diffuse * kDiffuse) * open;
}
`;

/** Colour of a bead in each of the views; `setColours` of the renderer sets its uniforms. */
export const colourOfBead = `
uniform float spacing;
uniform int view;
uniform int colourBy;
uniform vec3 feed;  // speed, largest flow, layer height
uniform sampler2D palette;

${lookOfBead}
vec3 ramp(float x) {  // dark blue over green to amber, even in lightness
  x = clamp(x, 0.0, 1.0);
  return x < 0.5 ? mix(vec3(0.16, 0.24, 0.55), vec3(0.16, 0.62, 0.55), 2.0 * x) : mix(vec3(0.16, 0.62, 0.55), vec3(0.98, 0.75, 0.25), 2.0 * x - 1.0);
}

// An order and a delay below 0 are not known.
vec3 colourOf(vec2 p, vec2 along, float side, float relief, float radius, float order, vec2 delay) {
  if (view == 0) return toned(look(p, along, side, relief));
  vec3 base = vec3(0.60, 0.60, 0.59);
  float known = colourBy == 3 ? order : colourBy == 4 ? delay.x / ${mostDelay.toFixed(1)} : 0.0;
  if (view == 2) {
    float ratio = 2.0 * radius / spacing;
    base = mix(base, vec3(0.25, 0.50, 0.84), smoothstep(0.8, 0.55, ratio));
    base = mix(base, vec3(0.78, 0.27, 0.23), smoothstep(1.25, 1.6, ratio));
  }
  else if (colourBy == 0) base = texture(palette, vec2(atan(along.y, along.x) / 3.14159265 + 0.5 / 256.0, 0.5)).rgb;
  else if (colourBy == 1) base = ramp((2.0 * radius / spacing - 0.5) / 1.0);
  else if (colourBy == 2) base = ramp(2.0 * min(1.0, feed.y / (2.0 * radius * feed.z * feed.x)) - 1.0);
  else if (colourBy == 5) {
    vec2 to = vec2(-along.y, along.x) * delay.y;
    if (delay.y > 1.5) base = vec3(0.12);  // squeezed: it leans to both sides
    else if (delay.y != 0.0) base = texture(palette, vec2(atan(to.y, to.x) / 6.28318531 + 0.5 / 256.0, 0.5)).rgb;
  }
  else if (known >= 0.0) base = ramp(known);
  return base * (1.0 - 0.35 * relief * side * side);
}
`;

/** Fragment shader of a capsule: coverage at its edge, and its colour. */
export const beadFragment = `#version 300 es
precision highp float;
in vec2 p;
flat in vec4 ends;
flat in vec4 tangents;
flat in vec2 radii;
flat in float order;
flat in vec2 delay;
uniform vec4 camera;
uniform float blended;  // 1: seen from too far away to tell beads apart
out vec4 colour;

${colourOfBead}
void main() {
  vec2 ab = ends.zw - ends.xy;
  float t = clamp(dot(p - ends.xy, ab) / max(dot(ab, ab), 1e-12), 0.0, 1.0);
  vec2 off = p - ends.xy - ab * t;
  float radius = mix(radii.x, radii.y, t);
  float distance = length(off);
  float pixels = radius * camera.z;
  // Half covered by each of two beads that touch, a pixel would show a quarter of the ground: edges lie a quarter pixel out.
  float alpha = clamp((radius - distance) * camera.z + 0.75, 0.0, 1.0);
  if (alpha <= 0.0) discard;
  vec2 along = normalize(mix(tangents.xy, tangents.zw, t));
  float side = clamp((along.x * off.y - along.y * off.x) / max(radius, 1e-6), -1.0, 1.0);
  float relief = (1.0 - blended) * clamp((pixels - 0.75) / 1.5, 0.0, 1.0);
  colour = vec4(colourOf(p, along, side, relief, radius, order, delay), alpha);
}
`;
