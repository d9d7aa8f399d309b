/** Ranks of a maximum as colours, and what they are estimated to be between the levels. */

/** The rank that a ray shows where it starts within shells, too. */
export const rankSource = `
precision highp float;
precision highp sampler2D;
uniform sampler2D measured;   // depth
uniform sampler2D tables;     // row 1: rank where n shells surround the start
uniform ivec3 table_sizes;
#ifdef STARTS
uniform sampler2D start_counts;
#endif
#ifdef TOOLS
uniform sampler2D tool_depth;
uniform vec2 tool_depths_mm;
#endif
#ifdef BOX
uniform mat3 ray_from, ray_way;  // of pixels (1, x, y), voxels
uniform vec3 box_lo, box_hi;
uniform float least_way;         // 0 where only what lies before the eye counts
#endif
out vec4 drawn;  // low and high byte; 1 where the background stays black

bool meets_volume() {
#ifdef BOX
  vec3 pixel = vec3(1.0, gl_FragCoord.xy);
  vec3 from = ray_from * pixel;
  vec3 way = ray_way * pixel;
  way = mix(vec3(1e-12), way, greaterThan(abs(way), vec3(1e-12)));
  vec3 a = (box_lo - from) / way;
  vec3 b = (box_hi - from) / way;
  vec3 enter = min(a, b);
  vec3 leave = max(a, b);
  float last = min(leave.x, min(leave.y, leave.z));
  return max(enter.x, max(enter.y, enter.z)) <= last && last >= least_way;
#else
  return true;
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  int rank = int(texelFetch(measured, pixel, 0).r * float(table_sizes.x - 1) + 0.5);
  bool is_outside = !meets_volume();
  bool stays = is_outside;
  float tool_mm = 3.0e38;
#ifdef TOOLS
  float tool_place = texelFetch(tool_depth, pixel, 0).r;
  if (tool_place < 1.0) {
    tool_mm = mix(tool_depths_mm.x, tool_depths_mm.y, tool_place);
    stays = true;  // the next pixel's vessel may lie behind the tool
  }
#endif
#ifdef STARTS
  int count = clamp(int(round(texelFetch(start_counts, pixel, 0).r)), 0, table_sizes.y - 1);
  if (tool_mm > 0.0) rank = max(rank, int(texelFetch(tables, ivec2(count, 1), 0).r + 0.5));
#endif
  if (is_outside) rank = 0;
  drawn = vec4(rank & 255, rank >> 8, stays ? 255 : 0, 255) / 255.0;
}
`;

/** Sums of the ranks above and below, so that the display looks at 5 pixels in place of 25. */
export const columnsSource = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D ranks;
uniform int stride;           // pixels a step
out uvec4 sums;               // rank, sums one and two steps off; 1 where the background stays black

uint rank_at(int below) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  pixel.y = clamp(pixel.y + stride * below, 0, textureSize(ranks, 0).y - 1);
  return uint(dot(texelFetch(ranks, pixel, 0).rg, vec2(255.0, 65280.0)) + 0.5);
}

void main() {
  bool stays = texelFetch(ranks, ivec2(gl_FragCoord.xy), 0).b > 0.0;
  sums = uvec4(rank_at(0), rank_at(-1) + rank_at(1), rank_at(-2) + rank_at(2), stays ? 1 : 0);
}
`;

/** Of the display: docs/derivations.md, 3.5. `measured` holds what `columnsSource` drew. */
export const estimateSource = `
uniform int stride;           // 0: layers as they are
uniform vec4 weights;         // of neighbours 1, 1.4, 2 and 2.2 steps away
uniform float far_weight;     // 2.8

vec3 column_at(ivec2 pixel, int aside) {
  pixel.x = clamp(pixel.x + stride * aside, 0, textureSize(measured, 0).x - 1);
  return vec3(texelFetch(measured, pixel, 0).rgb);
}

float between_levels(ivec2 pixel) {
  uvec4 here = texelFetch(measured, pixel, 0);
  int rank = int(here.r);
  float shown = texelFetch(tables, ivec2(rank, 0), 0).r;
  if (stride == 0 || (rank == 0 && here.a > 0u)) return shown;
  vec3 own = vec3(here.rgb);
  vec3 one = column_at(pixel, -1) + column_at(pixel, 1);
  vec3 two = column_at(pixel, -2) + column_at(pixel, 2);
  vec4 sums = vec4(one.x + own.y, one.y, two.x + own.z, two.y + one.z);
  float moved = dot(weights, sums - vec4(4.0, 4.0, 4.0, 8.0) * own.x) + far_weight * (two.z - 4.0 * own.x);
  moved = clamp(moved, -0.5, 0.5);
  if (moved == 0.0) return shown;
  return shown + moved * texelFetch(tables, ivec2(rank, moved < 0.0 ? 3 : 4), 0).r;
}
`;
