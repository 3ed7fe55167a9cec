#pragma once

namespace icome::render {

// The shaders of which scene_programs makes variants. Directions and positions are the camera's, colours
// linear. Variants instead of uniform conditions, because software renderers run both sides of those.

constexpr char kSceneVertexShader[] = R"(
#ifdef BUILT_IN
#define position gl_Vertex.xyz
#define normal gl_Normal
#else
in vec3 position;
in vec3 normal;
uniform mat4 clip_from_buffer;
#endif
#ifdef LIT
uniform mat4 camera_from_buffer;
uniform mat3 direction_from_buffer;
out vec3 seen_position;
out vec3 seen_normal;
#endif
#ifdef TEXTURED
in vec2 picture_place;
uniform vec3 picture_frame[2];
out vec2 place;
#endif
#ifdef COLOURED
in vec3 corner_colour;
out vec3 own_colour;
#endif
void main() {
#ifdef LIT
  seen_position = (camera_from_buffer * vec4(position, 1.0)).xyz;
  seen_normal = direction_from_buffer * normal;
#endif
#ifdef TEXTURED
  vec3 laid = vec3(picture_place, 1.0);
  place = vec2(dot(picture_frame[0], laid), dot(picture_frame[1], laid));
#endif
#ifdef COLOURED
  own_colour = corner_colour;
#endif
#ifdef BUILT_IN
  gl_Position = ftransform();
#else
  gl_Position = clip_from_buffer * vec4(position, 1.0);
#endif
}
)";

// The light at a point, from shadow maps side by side in one texture: MAPS in all, the first of them the
// shadowed sun's, SKIES others from all over the sky. Averaged over passes with some noise these melt into a
// soft light. With a single pass the sky has none, and the texture's filter alone softens the shadow's edge.
constexpr char kSceneLightShader[] = R"(
#if MAPS > 0
uniform sampler2DShadow shadow_map;
uniform mat4 shadow_from_camera[MAPS];
uniform float shadow_offset;
uniform float shadow_blur;
float lit(int which, vec3 p) {
  vec3 at = (shadow_from_camera[which] * vec4(p, 1.0)).xyz * 0.5 + 0.5;
  at.x = (clamp(at.x, 0.0, 1.0) + float(which)) / float(MAPS);
  at.z = clamp(at.z, 0.0, 1.0) - 0.0006;
  return texture(shadow_map, at);
}
#endif

uniform float noise_seed;
vec3 noise(vec2 pixel) {
  vec3 seed = fract(vec3(pixel.xyx) * vec3(0.1031, 0.1030, 0.0973) + 0.137 * noise_seed);
  seed += dot(seed, seed.yxz + 33.33);
  return fract((seed.xxy + seed.yzz) * seed.zyx) - 0.5;
}

uniform vec3 sky_up;
uniform vec3 sky_above;
uniform vec3 sky_below;
#if SKIES > 0
uniform vec3 to_sky[SKIES];
uniform vec3 sky_light[SKIES];
#endif
)";

// Light beyond what a screen can show is bent towards white instead of cut off, so that bright surfaces keep
// their shape.
constexpr char kToneShader[] = R"(
vec3 shoulder(vec3 light) {
  const float kBend = 0.75;
  vec3 over = max(light - kBend, 0.0) / (1.0 - kBend);
  return min(light, kBend) + (1.0 - kBend) * over / (1.0 + over);
}
// What is shown as that colour, which is no light: bent the other way where it will be bent with all else. The
// brightest end before white, as what becomes white is without end.
vec3 as_it_is(vec3 colour) {
#ifdef TONED
  return colour;
#else
  const float kBend = 0.75;
  vec3 over = (clamp(colour, kBend, 0.95) - kBend) / (1.0 - kBend);
  return min(colour, kBend) + (1.0 - kBend) * over / (1.0 - over);
#endif
}
)";

constexpr char kSceneFragmentShader[] = R"(
in vec3 seen_position;
in vec3 seen_normal;
#ifdef TEXTURED
in vec2 place;
uniform sampler2D picture;
#endif
#ifdef COLOURED
in vec3 own_colour;
#endif
uniform vec4 diffuse;
uniform vec4 specular;
uniform float metal;
uniform vec3 emission;
uniform float ambient;
#ifdef CUT_OUT
uniform float cutoff;
#endif
#ifdef SUN_GROUPS
uniform float sun_reaches[SUNS];
#endif
#if SUNS > 0
uniform vec3 to_sun[SUNS];
uniform vec3 sun_light[SUNS];
uniform vec3 sun_ambient[SUNS];
uniform float sun_gloss[SUNS];
#endif
#if LAMPS > 0
uniform vec3 lamp_at[LAMPS];
uniform vec3 lamp_light[LAMPS];
uniform vec3 lamp_ambient[LAMPS];
uniform vec4 lamp_fading[LAMPS];
#ifdef SPOTS
uniform vec3 lamp_along[LAMPS];
uniform vec2 lamp_cone[LAMPS];
#endif
#endif
out vec4 result;

vec3 n;
vec3 view;  // to the eye
vec3 shine;         // the colour of highlights
float there = 1.0;  // how much of the surface a picture leaves

// What reaches the eye of a light from that direction. Highlights cost as much as all else together: only
// what has them is drawn with them.
vec3 answer(vec3 to_light, vec3 light, vec3 body, float gloss) {
  float facing = max(dot(n, to_light), 0.0);
  vec3 answered = facing * body;
#if defined(SHINY) || defined(GLOSS)
  float along = max(dot(n, normalize(view + to_light)), 0.0);
#endif
#ifdef SHINY
  answered += (facing > 0.0 ? pow(along, specular.a) : 0.0) * there * shine;
#endif
#ifdef GLOSS
  float sheen = along * along;
  sheen *= sheen;
  sheen *= sheen;
  float narrower = sheen * sheen;
  answered += there * gloss * sheen * narrower * narrower;  // to the power of 40
#endif
  return light * answered;
}

void main() {
  vec4 own = diffuse;
#ifdef COLOURED
  if (own_colour.r > -0.5) own.rgb = own_colour;
#endif
#ifdef TEXTURED
  vec4 texel = texture(picture, place);
  own *= texel;
#endif
#ifdef CUT_OUT
  if (own.a < cutoff * diffuse.a) discard;
  own.a = diffuse.a;
#endif
#ifdef SHINY
  shine = specular.rgb + metal * own.rgb;
#endif
#ifdef BLENDED
#if defined(TEXTURED) && !defined(CUT_OUT)
  there = texel.a;
#endif
  vec3 body = own.rgb * own.a;
  vec3 radiance = emission * own.a;
#else
  vec3 body = own.rgb;
  vec3 radiance = emission;
#endif
#ifdef UNLIT
  result = vec4(as_it_is(own.rgb), 1.0);
#ifdef BLENDED
  result = vec4(result.rgb * own.a, own.a);
#endif
#else
  n = normalize(gl_FrontFacing ? seen_normal : -seen_normal);
#if defined(SHINY) || defined(GLOSS)
  view = normalize(-seen_position);
#endif
#if MAPS > 0
  vec3 lifted = seen_position + shadow_offset * n;
#endif
#if SKIES > 0
  vec3 spread = noise(gl_FragCoord.xy);
  // Within the surface's plane, so that the shift alone never puts a point into its own shadow.
  vec3 shifted = lifted + shadow_blur * (spread - dot(spread, n) * n);
  radiance += 0.035 * body;
  for (int i = 0; i < SKIES; ++i) {
    float facing = dot(n, to_sky[i]);
    if (facing > 0.0) radiance += sky_light[i] * facing * lit(i + 1, shifted) * body;
  }
#else
  radiance += mix(sky_below, sky_above, 0.5 + 0.333 * dot(n, sky_up)) * body;
#endif
#if SUNS > 0
  for (int i = 0; i < SUNS; ++i) {
    vec3 answered = answer(to_sun[i], sun_light[i], body, i == 0 ? sun_gloss[i] : 0.0);
#if SKIES > 0
    if (i == 0 && dot(n, to_sun[0]) > 0.0) answered *= lit(0, mix(lifted, shifted, 0.3));
#elif MAPS > 0
    if (i == 0) answered *= lit(0, lifted);
#endif
#ifdef SUN_AMBIENT
    answered += sun_ambient[i] * ambient * body;
#endif
#ifdef SUN_GROUPS
    answered *= sun_reaches[i];
#endif
    radiance += answered;
  }
#endif
#if LAMPS > 0
  for (int i = 0; i < LAMPS; ++i) {
    vec3 way = lamp_at[i] - seen_position;
    float distance = length(way);
    way /= max(distance, 1e-30);
    vec4 fading = lamp_fading[i];
    float fade = step(distance, fading.w) / max(fading.x + distance * (fading.y + distance * fading.z), 1e-6);
    fade = min(fade, 1.0);
#ifdef SPOTS
    // The angle where it ends, and how fast it grows to full light within the beam.
    float angle = acos(clamp(dot(-way, lamp_along[i]), -1.0, 1.0));
    fade *= clamp((lamp_cone[i].x - angle) * lamp_cone[i].y, 0.0, 1.0);
#endif
    radiance += fade * answer(way, lamp_light[i], body, 0.0);
    radiance += fade * lamp_ambient[i] * ambient * body;
  }
#endif
#ifdef BLENDED
#ifdef TONED
  radiance = shoulder(radiance / max(own.a, 1e-3)) * own.a;
#endif
  result = vec4(radiance, own.a);
#else
#ifdef TONED
  radiance = shoulder(radiance);
#endif
  result = vec4(radiance, 1.0);
#endif
#endif
}
)";

// The light that the ground misses, as black over the picture behind.
constexpr char kGroundFragmentShader[] = R"(
in vec3 seen_position;
in vec3 seen_normal;
uniform vec3 ground_middle;
uniform float ground_reach;
uniform vec3 to_sun[1];
uniform vec3 sun_light[1];
out vec4 result;
void main() {
  float away = length(seen_position - ground_middle) / ground_reach;
  float fade = 1.0 - smoothstep(0.3, 1.0, away);
  vec3 n = normalize(seen_normal);
  float missing = 0.0;
#if MAPS > 0
#if SKIES > 0
  vec3 spread = noise(gl_FragCoord.xy);
  vec3 p = seen_position + shadow_blur * (spread - dot(spread, n) * n);
#else
  vec3 p = seen_position;
#endif
  missing = sun_light[0].g * max(dot(n, to_sun[0]), 0.0) * (1.0 - lit(0, p));
#if SKIES > 0
  vec3 q = seen_position + 2.0 * shadow_blur * (spread - dot(spread, n) * n);
  for (int i = 0; i < SKIES; ++i) {
    // Light from near the horizon throws shadows too long for a picture.
    float height = smoothstep(0.15, 0.7, dot(n, to_sky[i]));
    if (height > 0.0) missing += height * sky_light[i].g * (1.0 - lit(i + 1, q));
  }
#endif
#endif
  result = vec4(0.0, 0.0, 0.0, 0.8 * fade * clamp(missing, 0.0, 1.0));
}
)";

// Lines on the plane y = 0 at every cell, ten cells and a hundred, finer ones fading as their cells become
// too small for the view; those through the world's origin in colours of their own. `place` counts cells
// from the middle of the drawn square.
constexpr char kGridVertexShader[] = R"(
in vec3 position;
uniform mat4 clip_from_buffer;
uniform float reach;
out vec2 place;
void main() {
  place = reach * position.xz;
  gl_Position = clip_from_buffer * vec4(position, 1.0);
}
)";

constexpr char kGridFragmentShader[] = R"(
in vec2 place;
uniform float reach;
uniform vec2 offset;
uniform vec2 origin;
uniform float fineness;
uniform vec4 colour;
uniform vec4 axis_colours[2];
out vec4 result;

// How much of the pixel lines cover; where there are many in one it comes to nothing.
float lines(vec2 p, vec2 pixel, float width) {
  vec2 away = abs(fract(p - 0.5) - 0.5) / pixel;
  vec2 cover = clamp(0.5 * width + 0.5 - away, 0.0, 1.0) * (1.0 - smoothstep(0.15, 0.4, pixel));
  return max(cover.x, cover.y);
}

void main() {
  vec2 pixel = max(fwidth(place), 1e-12);
  vec2 at = place + offset;
  float strength = max(max((1.0 - fineness) * 0.45 * lines(at, pixel, 1.0),
                           mix(1.0, 0.45, fineness) * lines(at / 10.0, pixel / 10.0, 1.0)),
                       lines(at / 100.0, pixel / 100.0, 1.0));
  vec4 line = vec4(colour.rgb, colour.a * strength);
  vec2 axis = clamp(1.5 - abs(place - origin) / pixel, 0.0, 1.0);
  line = mix(line, axis_colours[0], axis.y);
  line = mix(line, axis_colours[1], axis.x);
  line.a *= 1.0 - smoothstep(0.1, 1.0, length(place) / reach);
  result = vec4(line.rgb * line.a, line.a);
}
)";

/// A picture over all else, in its own colours; `corners` are its lower, then its upper ones, in clip space.
constexpr char kPanelVertexShader[] = R"(
uniform vec4 corners[4];
out vec2 place;
void main() {
  place = vec2(float(gl_VertexID & 1), 1.0 - float(gl_VertexID >> 1));
  gl_Position = corners[gl_VertexID];
}
)";

constexpr char kPanelFragmentShader[] = R"(
in vec2 place;
uniform sampler2D source;
uniform float alpha;
out vec4 result;
void main() { result = alpha * texture(source, place); }
)";

/// Depth only, for shadow maps, and flat colours, for masks.
constexpr char kFlatFragmentShader[] = R"(
#ifdef TEXTURED
in vec2 place;
uniform sampler2D picture;
uniform float cutoff;
#endif
uniform vec4 diffuse;
out vec4 result;
void main() {
#ifdef TEXTURED
  if (texture(picture, place).a < cutoff) discard;
#endif
  result = diffuse;
}
)";

/// Depths of another picture, brought to another scale; empty where that is empty.
constexpr char kDepthCopyFragmentShader[] = R"(
uniform sampler2D source;
uniform vec2 scale;
uniform vec2 corner;
void main() {
  float depth = texelFetch(source, ivec2(gl_FragCoord.xy - corner), 0).r;
  gl_FragDepth = depth < 1.0 ? clamp(scale.x * depth + scale.y, 0.0, 1.0) : 1.0;
}
)";

/// One colour where a picture of depths has something.
constexpr char kCoverFragmentShader[] = R"(
uniform sampler2D source;
uniform vec4 diffuse;
out vec4 result;
void main() {
  if (texelFetch(source, ivec2(gl_FragCoord.xy), 0).r >= 1.0) discard;
  result = diffuse;
}
)";

constexpr char kWholeVertexShader[] = R"(
out vec2 at;
void main() {
  at = vec2(float(gl_VertexID & 1) * 2.0, float(gl_VertexID & 2));
  gl_Position = vec4(2.0 * at - 1.0, 1.0, 1.0);  // as far as anything
}
)";

/// Adds a pass to the sum.
constexpr char kSumFragmentShader[] = R"(
uniform sampler2D source;
out vec4 result;
void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
)";

// The mean of the passes so far over a background that goes from above to below, mixed with the picture that
// was drawn at once before. Premultiplied.
constexpr char kMeanFragmentShader[] = R"(
in vec2 at;
uniform sampler2D source;
uniform sampler2D at_once;
uniform float share;
uniform float at_once_share;
uniform vec4 above;
uniform vec4 below;
uniform vec4 window;
out vec4 result;

void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  vec4 seen = share * texelFetch(source, here, 0);
  seen.a = clamp(seen.a, 0.0, 1.0);
  vec3 own = seen.a > 0.0 ? shoulder(seen.rgb / seen.a) * seen.a : shoulder(seen.rgb);
  vec4 behind = mix(below, above, window.y + window.w * at.y);
  vec4 all = vec4(own + (1.0 - seen.a) * behind.rgb * behind.a, seen.a + (1.0 - seen.a) * behind.a);
  all = mix(all, texelFetch(at_once, here, 0), at_once_share);
  result = vec4(dithered(all.rgb), all.a);
}
)";

/// The background alone, behind all that was drawn.
constexpr char kBackgroundFragmentShader[] = R"(
in vec2 at;
uniform vec4 above;
uniform vec4 below;
uniform vec4 window;
out vec4 result;
void main() {
  vec4 behind = mix(below, above, window.y + window.w * at.y);
  result = vec4(dithered(behind.rgb * behind.a), behind.a);
}
)";

// Less than one of 256 steps of noise hides the edges between the steps. The size of a step in light follows
// from the slope of the curve that screens have.
constexpr char kDitherShader[] = R"(
vec3 dithered(vec3 light) {
  vec3 noise = fract(vec3(gl_FragCoord.xyx) * vec3(0.1031, 0.1030, 0.0973));
  noise += dot(noise, noise.yzx + 33.33);
  float shift = (fract((noise.x + noise.y) * noise.z) - 0.5) / 255.0;
  return max(light + shift * max(vec3(0.077), 2.1 * sqrt(max(light, 0.0))), 0.0);
}
)";

/// A picture that is clear in places, as files and windows take it: not premultiplied.
constexpr char kClearFragmentShader[] = R"(
uniform sampler2D source;
out vec4 result;
vec3 screen(vec3 light) {
  vec3 low = 12.92 * light;
  vec3 high = 1.055 * pow(max(light, 1e-6), vec3(1.0 / 2.4)) - 0.055;
  return mix(low, high, step(0.0031308, light));
}
void main() {
  vec4 seen = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  result = vec4(seen.a > 0.0 ? screen(seen.rgb / seen.a) : vec3(0.0), seen.a);
}
)";

/// A line round the parts in the mask.
constexpr char kOutlineFragmentShader[] = R"(
uniform sampler2D source;
uniform vec4 colour;
uniform int reach;
out vec4 result;
void main() {
  ivec2 here = ivec2(gl_FragCoord.xy);
  ivec2 most = textureSize(source, 0) - 1;
  float inside = texelFetch(source, here, 0).r;
  float near = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (x * x + y * y > reach * reach + 1) continue;
      near += texelFetch(source, clamp(here + ivec2(x, y), ivec2(0), most), 0).r;
    }
  }
  result = colour * (1.0 - inside) * min(1.0, 0.5 * near);
}
)";

constexpr char kLineVertexShader[] = R"(
in vec3 position;
in vec3 normal;
uniform mat4 clip_from_buffer;
uniform vec2 half_width;
// Two corners on each side of a stretch: `normal` is its other end, the sign of the width in the vertex's number.
void main() {
  vec4 here = clip_from_buffer * vec4(position, 1.0);
  vec4 there = clip_from_buffer * vec4(normal, 1.0);
  float nearest = 1e-6 * max(abs(here.w), abs(there.w));
  if (here.w < nearest) here = mix(here, there, (nearest - here.w) / (there.w - here.w));
  if (there.w < nearest) there = mix(there, here, (nearest - there.w) / (here.w - there.w));
  vec2 along = (there.xy / there.w - here.xy / here.w) / half_width;
  float size = length(along);
  along = size > 0.0 ? along / size : vec2(1.0, 0.0);
  float side = (gl_VertexID & 1) == 0 ? 1.0 : -1.0;
  if ((gl_VertexID & 2) != 0) side = -side;
  gl_Position = here;
  gl_Position.xy += side * vec2(-along.y, along.x) * half_width * here.w;
}
)";

// A square that faces the eye round each place: `normal` gives the corner. In it a disc with a smooth rim.
constexpr char kDotVertexShader[] = R"(
in vec3 position;
in vec3 normal;
uniform mat4 clip_from_buffer;
uniform vec2 half_width;
out vec2 place;
void main() {
  place = normal.xy;
  gl_Position = clip_from_buffer * vec4(position, 1.0);
  gl_Position.xy += place * half_width * gl_Position.w;
}
)";

constexpr char kDotFragmentShader[] = R"(
in vec2 place;
uniform vec4 diffuse;
out vec4 result;
void main() {
  float away = length(place);
  float cover = clamp((1.0 - away) / max(fwidth(away), 1e-6) + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  result = cover * diffuse;
}
)";

}  // namespace icome::render
