// The sea: createOcean() bakes one, frames are functions of its options and the time alone, with the same bits in every browser,
// in node and in the native library. Lengths are metres, times seconds, angles radians; x points east, y up, z south.

/** Which sea. Unknown names, other types, NaN and what is out of range are refused by an Error of one line. */
export interface SeaOptions {
  /** A named sea to start from; presets() has all. */
  preset?: string;
  /** Which waves there are: those of a wind's spectrum, up to 64 waves that morph, a pond's. Default "spectrum". */
  waves?: 'spectrum' | 'analytic' | 'pond';
  /** Default "jonswap". */
  spectrum?: 'phillips-paper' | 'phillips' | 'pierson-moskowitz' | 'jonswap';
  /** How waves spread around the wind. Default "paper". */
  spreading?: 'paper' | 'cosine-2s' | 'hasselmann' | 'donelan-banner';
  /** Cascades, each with a band of the waves: 1, 2, 3 or 4, or 0: chosen. Default 0, which is 4, or 1 where the side is given. */
  cascades?: number;
  /** Texels along a side of each cascade: a power of two from 16 to 2048, or 0: chosen. Default 0, which is 128, or 256 where the side is given. */
  resolution?: number;
  /** One cascade of this side, metres, after which the sea repeats: [0.001, 1e6], or 0: chosen. Default 0: sides chosen from the sea. */
  patchSizeM?: number;
  /** Mean wind 10 m above the sea, metres a second: (0, 60]. Default 12. */
  windSpeedMps?: number;
  /** Where the wind blows towards, from +x towards +z, radians: [-2 pi, 2 pi]. Default 0. */
  windDirectionRad?: number;
  /** How far the wind has blown over water, metres: (0, 2e6]. Default 100000. */
  fetchM?: number;
  /** Depth of the water, metres: [0.01, 11000]. Default 4000. */
  depthM?: number;
  /** Horizontal motion that sharpens crests: [0, 1]. Default 0.8. */
  choppiness?: number;
  /** Of the water between texels: [0, 1], or -1: from the wind. Default -1. */
  roughness?: number;
  /** Damping of small waves: [0, 1]. 1 removes those shorter than a quarter of the peak's. Default 0. */
  shortWaveCutoff?: number;
  /** Of the waves with the wind, where spreading is "paper": [0, 1]. Default 0.5. */
  windAlignment?: number;
  /** Significant height of waves from elsewhere, metres: [0, 30]. Default 0: none. */
  swellHeightM?: number;
  /** Peak period of the swell, seconds: [1, 40]. Default 12. */
  swellPeriodS?: number;
  /** Where the swell runs towards, radians: [-2 pi, 2 pi]. Default 0. */
  swellDirectionRad?: number;
  /** Standard deviation of the swell's directions, radians: [pi/180, 4 pi/9]. Default 0.26179938779914943. */
  swellSpreadRad?: number;
  /** The sea repeats exactly after this time, seconds: [0.1, 86400]. Default 200. */
  loopPeriodS?: number;
  /** Which sea of this kind: a whole number from 0 to 4294967295. Default 1. */
  seed?: number;
  /** Waves of an analytic sea, octaves of a pond: 1 to 64, or 0: chosen. Default 0. */
  waveCount?: number;
  /** Their longest, metres: [0.02, 1000], or 0: chosen. Default 0. */
  longestWaveM?: number;
  /** Their shortest, metres: [0.01, 1000], or 0: chosen. Default 0. */
  shortestWaveM?: number;
  /** Of an analytic sea: [0, 2]. 0 calm, 1 moderate, 2 intense. Default 1. */
  waveStrength?: number;
  /** Significant height of an analytic sea or pond, metres: [0, 30], 0: chosen. Default 0. */
  waveHeightM?: number;
  /** How far a pond's long waves move its short ones: [0, 1]. Default 0.38. */
  waveDrag?: number;
}

/** A sea, and what comes with its frames. None of the latter changes a bit of the sea but foam, and that only foam. */
export interface OceanOptions extends SeaOptions {
  /**
   * Threads that compute, 1 to 64. Default: one on a page's own thread and where a page is not isolated (crossOriginIsolated), else one a
   * core, 8 at most. The bits are the same for any number. More than one on a page's own thread is refused: it must not wait.
   */
  threads?: number;
  /** Frames can be asked by query() and firstHit(). Default false. */
  queries?: boolean;
  /** Frames have velocities, and so have answers of query(). About twice the work. Default false. */
  velocities?: boolean;
  /** Frames of several cascades have gradients too; those of one always do. Default false. */
  gradients?: boolean;
  /** Frames of one cascade have slopes and moments too; those of several always do. Default false. */
  slopes?: boolean;
  /** Foam lasts for 2.9 seconds, and has its own map. Default false. */
  foam?: boolean;
}

/** Bakes the sea's spectrum. Each ocean has a memory of its own, which goes with dispose() or when nobody holds it any longer. */
export function createOcean(options?: OceanOptions): Promise<Ocean>;

/** An option of the sea, as the library has it. */
export interface SeaOption {
  name: string;
  default: number | string;
  /** The range in words: "(0, 60]". */
  accepted: string;
  least?: number;
  most?: number;
  /** Of an option that is one of some words. */
  words?: string[];
}
export function seaOptions(): Promise<SeaOption[]>;

export interface SeaPreset {
  name: string;
  summary: string;
  sea: Required<Omit<SeaOptions, 'preset'>>;
}
/** The named seas, the mildest first, then the open sea of each force of wind, beaufort-0 to beaufort-12. */
export function presets(): Promise<SeaPreset[]>;

/**
 * A sea on the thread that made it. A frame is computed while another is drawn: schedule() the next, draw, complete() it. With one thread
 * complete() does all the work. Methods throw an Error of one line; what they were asked for didn't happen then.
 */
export class Ocean {
  private constructor();
  /** Starts the frame of any finite time, in any order, and returns at once. */
  schedule(timeS: number): void;
  /** complete() would not wait for other threads. */
  isReady(): boolean;
  /** Waits for the frame that is scheduled. It is valid until the second schedule() from now. */
  complete(): Frame;
  /** schedule() and complete() in one. */
  frameAt(timeS: number): Frame;

  /** Asks the frame completed last. */
  query(points: Points, options?: QueryOptions): Answers;
  /** Asks the frame completed last. */
  firstHit(ray: Ray): Hit | null;

  /**
   * Starts to bake another sea beside frames, which go on as they are: this one with `options` changed, or a preset on the cascades of this one.
   * The resolution must stay.
   */
  scheduleSea(options: SeaOptions): void;
  /** completeSea() would not wait for other threads. */
  seaIsReady(): boolean;
  /** Frames scheduled from now on show the sea given to scheduleSea(). */
  completeSea(): void;
  /** scheduleSea() and completeSea() in one. */
  changeSea(options: SeaOptions): void;
  /** The sea turns into another one, wave by wave, from a time of the sea and over so many seconds. */
  turnInto(options: SeaOptions, when: {fromS: number; overS: number}): void;

  /** The last sea that frames will have, every option of it. */
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly threads: number;
  /** Frames are in memory that workers share. */
  readonly isShared: boolean;
  /** All that this ocean holds of its module's memory. */
  readonly memoryBytes: number;

  /** Ends its threads and frees its memory; frames are over. Also as `using ocean = ...`, where there is Symbol.dispose. */
  dispose(): void;
}

/** Extremes of displacements, metres. */
export interface Bounds {
  heightMinM: number;
  heightMaxM: number;
  horizontalXMaxM: number;
  horizontalZMaxM: number;
}

/** Mean squares of slopes, along the wind and across. */
export interface SlopeVariance {
  upwind: number;
  crosswind: number;
}

/** What holds for all frames of a sea. */
export interface SeaStatistics {
  significantWaveHeightM: number;
  /** That the cascades' maps show, and what is left to roughness. */
  resolvedSlopes: SlopeVariance;
  unresolvedSlopes: SlopeVariance;
  roughness: number;
  /** How fast foam drifts. */
  foamDriftXMps: number;
  foamDriftZMps: number;
}

/** What a frame says of itself. */
export interface FrameAbout {
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  /** "wasm128": the instruction set. */
  readonly isa: string;
  /** Sums of the cascades' bounds. */
  readonly bounds: Bounds;
}

/**
 * The point of water that has the reference position (x, z) is drawn at (x + Dx, height, z + Dz), each the sum of what the cascades hold there.
 * Valid until the second schedule() after its own, and until dispose(); later it throws.
 */
export class Frame implements FrameAbout {
  private constructor();
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  readonly isa: string;
  readonly bounds: Bounds;
  /** At least one, the coarsest first. */
  readonly cascades: readonly Cascade[];
  readonly isValid: boolean;
  /** XXH3 of all its outputs, 16 hexadecimal digits: equal hashes, equal bits. `pelagic export` writes the same into sea.json. */
  hash(): string;
  /** The same of the foam that lasts. */
  foamHash(): string;
  /** Heights, normals and more at any points. Throws without OceanOptions.queries. */
  query(points: Points, options?: QueryOptions): Answers;
  /** The first place where the ray passes through the surface, from above or from below. Throws without OceanOptions.queries. */
  firstHit(ray: Ray): Hit | null;
}

/** What a cascade says of itself. */
export interface CascadeAbout {
  /** L: the cascade repeats after so many metres along both of its own axes. */
  readonly sideM: number;
  /** N, texels along a side. */
  readonly resolution: number;
  /** L / N. */
  readonly texelM: number;
  /**
   * Its grid is rotated against the world, from +x towards +z: texel (i, j) rests at x = (c i - s j) L/N, z = (s i + c j) L/N, c and s
   * being cosine and sine. What texels hold is in the world's axes.
   */
  readonly rotationRad: number;
  readonly cosine: number;
  readonly sine: number;
  readonly bounds: Bounds;
  /** What the bytes of `slopes` and `moments` count in. */
  readonly slopeRange: number;
  readonly varianceRange: number;
  /** Of the slope over the whole cascade. */
  readonly slopeVariance: number;
  /** Water of the Jacobian J makes foam of clamp(1/2 + (whitecapJacobian - J) / whitecapRamp, 0, 1). */
  readonly makesWhitecaps: boolean;
  readonly whitecapJacobian: number;
  readonly whitecapRamp: number;
}

/**
 * The maps of a cascade, with rows of texels along its own first axis. They are views of the module's memory, without a copy: as long as
 * the frame is valid they hold its bits, then those of another frame. Memory grows when an ocean answers a larger batch of points than
 * ever, or changes its sea; a view that you kept has no elements then, unless isShared. So read `cascade.displacement` again for each use, which costs
 * nothing, and copy what you keep.
 */
export interface CascadeMaps {
  /** N^2 texels of four IEEE half floats: Dx, height, Dz in metres, foam from 0 to 1 (RGBA16F). */
  readonly displacement: Uint16Array;
  /**
   * A chain of levelCount(N) levels, RGBA8: normal x, normal z, Jacobian, smoothness. Of this cascade alone. Null in frames of
   * several cascades without OceanOptions.gradients.
   */
  readonly gradients: Uint8Array | null;
  /**
   * Two chains, RGBA8, of slopes that add to other cascades': h_x, h_z, D_xx, D_zz; and D_xz, variances of h_x and h_z within the
   * texel, their covariance. Variances are b/255 varianceRange, the covariance (b - 128)/127 of it, all others (b - 128)/127 slopeRange.
   * The normal of the sums is (h_z D_xz - h_x (1 + D_zz), J, h_x D_xz - h_z (1 + D_xx)), J = (1 + D_xx)(1 + D_zz) - D_xz^2.
   * Null in frames of one cascade without OceanOptions.slopes.
   */
  readonly slopes: Uint8Array | null;
  readonly moments: Uint8Array | null;
  /** A chain of foam, one byte a texel. Null without OceanOptions.foam. */
  readonly foam: Uint8Array | null;
  /** Metres, in single precision. */
  readonly dx: Plane;
  readonly height: Plane;
  readonly dz: Plane;
  /** Metres a second. Null without OceanOptions.velocities. */
  readonly velocityX: Plane | null;
  readonly velocityY: Plane | null;
  readonly velocityZ: Plane | null;
}

export interface Cascade extends CascadeAbout, CascadeMaps {}

/**
 * A square of floats in blocks of a few columns, which is how they are computed; a view as maps are. Texel (i, j) is
 * data[floor(i / blockColumns) blockStride + j rowStride + i % blockColumns].
 */
export class Plane {
  private constructor();
  readonly data: Float32Array;
  readonly resolution: number;
  readonly blockColumns: number;
  readonly rowStride: number;
  readonly blockStride: number;
  at(i: number, j: number): number;
  /** A copy in tight rows, texel (i, j) at j N + i. */
  toRows(out?: Float32Array): Float32Array;
}

/** Levels in a chain: N, N / 2, ..., 1 texels along a side. */
export function levelCount(resolution: number): number;
/** First texel of a level in its chain. */
export function levelOffset(resolution: number, level: number): number;

/** Places of the world, metres: x, z, x, z, ... or pairs. */
export type Points = ArrayLike<number> | readonly (readonly [number, number])[] | readonly {x: number; z: number}[];

export interface QueryOptions {
  /** Largest error of a converged point, metres. Default 0.001. */
  toleranceM?: number;
  /**
   * "linear", the default, is the surface that is drawn. "cubic" is for measurements: it keeps the heights and slopes of short waves,
   * for 2 to 4 times the work. Foam is linear in both.
   */
  interpolation?: 'linear' | 'cubic';
}

/** An element, or three, for each point; copies that are yours. */
export interface Answers {
  heightM: Float32Array;
  /** x, y, z of the unit normal of the displaced surface. */
  normal: Float32Array;
  /** 1 at rest, small at sharp crests, negative where the sheet is overturned. */
  jacobian: Float32Array;
  /** How far horizontal from the given point the sampled one is drawn, and 1 if that is within the tolerance. */
  errorM: Float32Array;
  converged: Uint8Array;
  /** x, y, z of how the water there moves. With OceanOptions.velocities. */
  velocityMps?: Float32Array;
  /** How much of the water is white, 0 to 1. With OceanOptions.foam. */
  foam?: Float32Array;
}

export interface Ray {
  originM: readonly [number, number, number];
  /** Of any length but 0. */
  direction: readonly [number, number, number];
  /** How far to look: 0 to a million texels of the coarsest cascade. */
  reachM: number;
}

export interface Hit {
  distanceM: number;
  positionM: [number, number, number];
  normal: [number, number, number];
  /** The ray comes out of the water. */
  fromBelow: boolean;
}
