/** GLSL ES 3.00 with the names and formulas of render/gl. */
import { estimateSource } from "./layer_shaders";

export const vertexSource = `
layout(location = 0) in vec3 position_mm;
uniform vec4 clip_x, clip_y, clip_w;
uniform vec4 depth_from_local;
out highp float depth_mm;
#ifdef NORMALS
layout(location = 1) in vec3 normal;
NORMALS out vec3 surface_normal;
#endif
#ifdef REMAP
uniform vec2 z_of_depth;
uniform vec2 remap;  // depth at z = 0 and at z = 1
#endif
#ifdef LINEAR
uniform vec2 depths_mm;
#endif

void main() {
  vec4 p = vec4(position_mm, 1.0);
  depth_mm = dot(depth_from_local, p);
  float w = dot(clip_w, p);
  float depth = 0.5;
#ifdef REMAP
  depth = mix(remap.x, remap.y, clamp(z_of_depth.x + z_of_depth.y * depth_mm, 0.0, 1.0));
#endif
#ifdef LINEAR
  depth = (depth_mm - depths_mm.x) / (depths_mm.y - depths_mm.x);
#endif
  gl_Position = vec4(dot(clip_x, p), dot(clip_y, p), (2.0 * depth - 1.0) * w, w);
#ifdef NORMALS
  surface_normal = normal;
#endif
}
`;

export const fragmentPrelude = `
precision highp float;
precision highp sampler2D;
in highp float depth_mm;
uniform float end_mm;
uniform vec2 z_of_depth;
uniform vec2 cue;
uniform vec2 cue_range;
uniform vec4 slope_of_pixel;
uniform mat3 local_from_view;
#ifdef NORMALS
NORMALS in vec3 surface_normal;
#endif
#ifdef TOOLS
uniform sampler2D tool_depth;
uniform vec2 tool_depths_mm;
#endif

float ray_end_mm() {
#ifdef TOOLS
  float depth = texelFetch(tool_depth, ivec2(gl_FragCoord.xy), 0).r;
  return depth < 1.0 ? min(end_mm, mix(tool_depths_mm.x, tool_depths_mm.y, depth)) : end_mm;
#else
  return end_mm;
#endif
}

bool outside_ray() { return depth_mm < 0.0 || depth_mm > ray_end_mm(); }
float depth_z() { return clamp(z_of_depth.x + z_of_depth.y * depth_mm, 0.0, 1.0); }
float cue_at_depth() { return clamp(cue.x + cue.y * depth_mm, cue_range.x, cue_range.y); }
vec3 ray_way() { return vec3(slope_of_pixel.xy + slope_of_pixel.zw * gl_FragCoord.xy, 1.0); }
vec3 local_way() { return local_from_view * ray_way(); }
float cue_integral(float d) { return length(ray_way()) * d * (cue.x + 0.5 * cue.y * d); }
float headlight(float cosine) { return 0.2 + 0.8 * max(cosine, 0.0); }
`;

/** The remapped depth is the picture; where nothing is cut, nothing is left to do here. */
export const maxSource = `
#ifdef WRITE_DEPTH
uniform vec2 remap;
#endif
void main() {
#ifdef CUT
  if (outside_ray()) discard;
#endif
#ifdef WRITE_DEPTH
  gl_FragDepth = mix(remap.x, remap.y, depth_z());
#endif
}
`;

export const crossingsSource = `
uniform float weight;
out vec4 added;
void main() {
  float leaving = gl_FrontFacing ? -1.0 : 1.0;
  float value = 0.0;
#if defined(SUM)
  value = weight * leaving * cue_integral(clamp(depth_mm, 0.0, max(ray_end_mm(), 0.0)));
#elif defined(COUNT)
  if (outside_ray()) discard;
  value = weight;
#elif defined(AT_START)
  value = depth_mm > 0.0 ? leaving : 0.0;
#else
  value = depth_mm > ray_end_mm() ? leaving : 0.0;
#endif
  added = vec4(value);
}
`;

const linearDepth = `
#ifdef WRITE_DEPTH
uniform vec2 depths_mm;
void write_depth() { gl_FragDepth = (depth_mm - depths_mm.x) / (depths_mm.y - depths_mm.x); }
#else
void write_depth() {}
#endif
`;

export const litSource = `${linearDepth}
out vec4 brightness;
void main() {
#ifdef CUT
  if (outside_ray()) discard;
#endif
  float cosine = -dot(normalize(surface_normal), normalize(local_way()));
  brightness = vec4(headlight(cosine) * cue_at_depth());
  write_depth();
}
`;

export const toolSource = `${linearDepth}
uniform vec3 color;
out vec4 seen;
void main() {
  float cosine = abs(dot(surface_normal, normalize(local_way())));
  seen = vec4(color * (headlight(cosine) * cue_at_depth()), 1.0);
  write_depth();
}
`;

export const screenVertexSource = `
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
`;

/** Reads the measured picture, raises it where rays start or end in shells, and shows it. */
export const displaySource = `
precision highp float;
precision highp sampler2D;
#ifdef LAYERS
uniform highp usampler2D measured;
#else
uniform sampler2D measured;   // depth, or a colour target
#endif
uniform sampler2D tables;     // row 0: emission of a rank; 1, 2: of a start, end count;
                              // 3, 4: emission a layer below and above a rank's
uniform sampler2D color_map;
uniform ivec3 table_sizes;
uniform float depth_scale;    // 0: depths are ranks
uniform vec2 window;          // lo, 1 / (hi - lo)
uniform int height;
uniform vec2 cue;
uniform vec2 cue_range;
uniform float end_mm;
uniform int blend;            // 0: brighter of both, 1: added, 2: over
uniform bool inverted;
#ifdef STARTS
uniform sampler2D start_counts;
#endif
#ifdef ENDS
uniform sampler2D end_counts;
#endif
#ifdef TOOLS
uniform sampler2D tool_color;
uniform sampler2D tool_depth;
uniform vec2 tool_depths_mm;
#endif
out vec4 shown;
#ifdef LAYERS
${estimateSource}
#endif

float at_count(sampler2D counts, int row, ivec2 pixel, float depth_mm) {
  int most = (row == 1 ? table_sizes.y : table_sizes.z) - 1;
  int count = clamp(int(round(texelFetch(counts, pixel, 0).r)), 0, most);
  float beta = clamp(cue.x + cue.y * depth_mm, cue_range.x, cue_range.y);
  return texelFetch(tables, ivec2(count, row), 0).r * beta;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  pixel.y = height - 1 - pixel.y;
#ifdef LAYERS
  float value = between_levels(pixel);
#else
  float value = texelFetch(measured, pixel, 0).r;
#endif
#ifdef DEPTHS
  if (depth_scale > 0.0) {
    value *= depth_scale;
  } else {
    int rank = int(value * float(table_sizes.x - 1) + 0.5);
    value = texelFetch(tables, ivec2(rank, 0), 0).r;
  }
#endif
  float tool_mm = 3.0e38;
#ifdef TOOLS
  float tool_place = texelFetch(tool_depth, pixel, 0).r;
  if (tool_place < 1.0) tool_mm = mix(tool_depths_mm.x, tool_depths_mm.y, tool_place);
#endif
#ifdef STARTS
  if (tool_mm > 0.0) value = max(value, at_count(start_counts, 1, pixel, 0.0));
#endif
#ifdef ENDS
  if (tool_mm > 0.0) value = max(value, at_count(end_counts, 2, pixel, min(end_mm, tool_mm)));
#endif
  float brightness = clamp((value - window.x) * window.y, 0.0, 1.0);
  vec3 color = texture(color_map, vec2(brightness * (1023.0 / 1024.0) + 0.5 / 1024.0, 0.5)).rgb;
#ifdef TOOLS
  if (tool_place < 1.0) {
    vec3 tool = texelFetch(tool_color, pixel, 0).rgb;
    if (blend == 2) {
      color = value > 0.0 ? color : tool;
    } else {
      vec3 a = inverted ? 1.0 - color : color;
      vec3 b = inverted ? 1.0 - tool : tool;
      vec3 both = blend == 1 ? min(a + b, 1.0) : max(a, b);
      color = inverted ? 1.0 - both : both;
    }
  }
#endif
  shown = vec4(color, 1.0);
}
`;
