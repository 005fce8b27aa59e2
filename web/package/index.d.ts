// Oceans in a page or in node. A frame is a function of the options and the time alone,
// bit-identical in every browser, in node and in the native library. Units: metres, seconds,
// radians. Axes: x points east, y up, z south.

/** A wave system: waves of one spectrum and one spreading. */
export interface WaveSystem {
  // generated from schema/wave_system.toml: properties
  /**
   * Spectrum: jonswap, pierson-moskowitz or phillips. "phillips-paper": scaled as in VR Ocean,
   * without a swell. "phillips": Phillips' shape with a physical height. "pierson-moskowitz": a
   * fully developed sea; no fetch. "jonswap": a sea that grows with the fetch. "none": no wind
   * sea: only the swell and systems; the wind still sets roughness, drift, and foam on waves that
   * it can raise. By height, pierson-moskowitz is jonswap with gamma 1. Default "jonswap".
   */
  spectrum?: 'phillips-paper' | 'phillips' | 'pierson-moskowitz' | 'jonswap' | 'none';
  /**
   * Directional spreading, where spreadRad is 0. "paper": VR Ocean, by windAlignment.
   * "cosine-2s": measured, Longuet-Higgins et al. 1963. "hasselmann": measured, Hasselmann et al.
   * 1980. "donelan-banner": measured, Donelan et al. 1985 and Banner 1990. Hasselmann's and
   * cosine-2s depend on the wind; by height and period it is the wind that raises such waves in
   * JONSWAP's growth. Default "donelan-banner".
   */
  spreading?: 'paper' | 'cosine-2s' | 'hasselmann' | 'donelan-banner';
  /** U10 of the wind of the system, metres per second: (0, 60]. Default 12. */
  windSpeedMps?: number;
  /** Distance that it has blown over water (jonswap), metres: (0, 2e6]. Default 100000. */
  fetchM?: number;
  /**
   * Significant wave height, Hm0, metres: (0, 30], or 0: by the wind. With peakPeriodS, the
   * system has both at any depth. Of one alone, the other follows as of the wind sea. Default 0:
   * by the wind and peakPeriodS.
   */
  heightM?: number;
  /** Peak period, seconds: [1, 40], or 0: by the wind. Default 0: by the wind and heightM. */
  peakPeriodS?: number;
  /**
   * Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap):
   * [1, 10]. Default 3.3.
   */
  peakEnhancement?: number;
  /**
   * Direction that the waves run towards, from +x towards +z, radians: [-2 pi, 2 pi]. Default 0.
   */
  directionRad?: number;
  /**
   * Standard deviation of the directions, radians: [pi/180, 4 pi/9], or 0: by the spreading
   * model. Default 0: by spreading.
   */
  spreadRad?: number;
  // end of generated
}

/**
 * A sea state. createOcean() rejects unknown names, other types, NaN and values out of range with
 * an Error of one line.
 */
export interface SeaOptions {
  /** Name of a sea whose options are the defaults of the others; presets() has all. */
  preset?: string;
  // generated from schema/sea.toml: properties
  /**
   * Wave model. Only a spectrum uses spectrum, spreading, fetchM, peakPeriodS, lean,
   * shortWaveCutoff, windAlignment, the swell, systems and seed, and only a spectrum and a
   * regular wave depthM. Only the other models use waveCount and the options after it but
   * waveHeightM and systems. All models use the wind, whose direction is that of their waves.
   * Default "spectrum".
   */
  waves?: 'spectrum' | 'analytic' | 'pond' | 'regular';
  /**
   * Wave spectrum. "phillips-paper": scaled as in VR Ocean, without a swell. "phillips":
   * Phillips' shape with a physical height. "pierson-moskowitz": a fully developed sea; no fetch.
   * "jonswap": a sea that grows with the fetch. "none": no wind sea: only the swell and systems;
   * the wind still sets roughness, drift, and foam on waves that it can raise. Default "jonswap".
   */
  spectrum?: 'phillips-paper' | 'phillips' | 'pierson-moskowitz' | 'jonswap' | 'none';
  /**
   * Directional spreading. "paper": VR Ocean, by windAlignment. "cosine-2s": measured,
   * Longuet-Higgins et al. 1963. "hasselmann": measured, Hasselmann et al. 1980.
   * "donelan-banner": measured, Donelan et al. 1985 and Banner 1990. The spectrum phillips-paper
   * always has paper, and refuses cosine-2s and hasselmann. Default "donelan-banner".
   */
  spreading?: 'paper' | 'cosine-2s' | 'hasselmann' | 'donelan-banner';
  /**
   * Number of cascades, each a band of wavelengths: 1, 2, 3 or 4, or 0: chosen. More than one
   * excludes patchSizeM. Default 0: four, or one if patchSizeM is set, the resolution is 16 or
   * the model has only one.
   */
  cascades?: number;
  /**
   * N, texels along a side of each cascade: a power of two from 16 to 2048, or 0: chosen. Default
   * 0: 128, or 256 if patchSizeM is set.
   */
  resolution?: number;
  /**
   * L, the side of the only cascade, after which the sea repeats, metres: [0.001, 1e6], or 0:
   * chosen. Default 0: sides derived from the sea.
   */
  patchSizeM?: number;
  /** U10, mean wind speed 10 m above the sea, metres per second: (0, 60]. Default 12. */
  windSpeedMps?: number;
  /**
   * Direction that the wind blows towards, from +x towards +z, radians: [-2 pi, 2 pi]. Default 0.
   */
  windDirectionRad?: number;
  /**
   * Distance that the wind has blown over water (jonswap), of which at most 17,000 U10^2 / g has
   * an effect, metres: (0, 2e6]. Excludes waveHeightM and peakPeriodS. Default 100000.
   */
  fetchM?: number;
  /**
   * Peak period of the wind sea (jonswap, pierson-moskowitz), seconds: [1, 40], or 0: chosen.
   * With waveHeightM, the wind sea has that height and period at any depth. Of one alone, the
   * other follows from JONSWAP's growth in this wind with the fetch eliminated; of
   * pierson-moskowitz, from its peak. Default 0: by waveHeightM and the wind.
   */
  peakPeriodS?: number;
  /**
   * Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap):
   * [1, 10]. Default 3.3.
   */
  peakEnhancement?: number;
  /**
   * Depth of the water, which slows and lowers long waves, metres: [0.01, 11000]. Waves higher
   * than 0.6 of it break. Default 4000.
   */
  depthM?: number;
  /** Scale of horizontal displacements: [0, 1]. 0 gives a height field. Default 0.8. */
  choppiness?: number;
  /**
   * Forward displacement of crests of the wind sea, as a fraction of the displacement that
   * sharpens them: [0, 0.6], or -1: from the wind. It makes fronts steeper than backs. A swell
   * and systems do not lean. Default -1: 0 up to 3 m/s, 0.42 at 10 m/s, 0.52 at 20 m/s; 0 for
   * phillips-paper.
   */
  lean?: number;
  /**
   * GGX roughness of unresolved waves, for the smoothness channel: [0, 1], or -1: from the wind.
   * Default -1: from the slopes that the cascades do not resolve in this wind.
   */
  roughness?: number;
  /**
   * 0 keeps short waves, 1 removes waves shorter than a quarter of the peak wavelength: [0, 1].
   * Default 0.
   */
  shortWaveCutoff?: number;
  /**
   * Alignment of waves with the wind, alpha of equations 6 to 9, for the spreading paper: [0, 1].
   * With 0 a third of the energy runs against the wind and little across it; with 1 a hundredth
   * runs against it. Default 0.5.
   */
  windAlignment?: number;
  /**
   * Significant wave height of a swell, in addition to the waves of the wind, metres: [0, 30]. 0:
   * no swell. Default 0.
   */
  swellHeightM?: number;
  /** Peak period of the swell, seconds: [1, 40]. Default 12. */
  swellPeriodS?: number;
  /**
   * Direction that the swell runs towards, as windDirectionRad, radians: [-2 pi, 2 pi]. Default
   * 0.
   */
  swellDirectionRad?: number;
  /**
   * Standard deviation of the swell's directions, radians: [pi/180, 4 pi/9]. 15 degrees by
   * default. Default 0.2617993877991494.
   */
  swellSpreadRad?: number;
  /**
   * T, the period after which the sea repeats exactly, seconds: [0.1, 86400]. Waves keep their
   * frequency within 1 / (2 T): in short loops groups of waves move in steps. Default 3600.
   */
  loopPeriodS?: number;
  /** Seed of the random phases and amplitudes: a whole number from 0 to 4294967295. Default 1. */
  seed?: number;
  /**
   * Number of analytic waves or of pond octaves: 1 to 64, or 0: chosen. Default 0: 16 analytic
   * waves, 24 pond octaves.
   */
  waveCount?: number;
  /**
   * Longest wavelength of an analytic sea or a pond, metres: [0.02, 1000], or 0: chosen. Default
   * 0: 120, of a pond 1.2.
   */
  longestWaveM?: number;
  /**
   * Shortest wavelength, at most the longest, metres: [0.01, 1000], or 0: chosen. Default 0: the
   * longest / 60, of a pond / 45.
   */
  shortestWaveM?: number;
  /**
   * Strength of analytic waves: 0 calm, 1 moderate, 2 intense, interpolated between: [0, 2].
   * Default 1.
   */
  waveStrength?: number;
  /**
   * Significant wave height of the wind sea (jonswap, pierson-moskowitz), of an analytic sea or
   * of a pond, metres: (0, 30], or 0: chosen. Default 0: from the wind, of analytic waves from
   * waveStrength, of a pond 0.017 longestWaveM.
   */
  waveHeightM?: number;
  /** Horizontal drag of a pond's short waves by its long ones: [0, 1]. Default 0.38. */
  waveDrag?: number;
  /** Height of a regular wave from trough to crest, metres: (0, 60]. Default 2. */
  regularHeightM?: number;
  /**
   * Period of a regular wave, seconds: [0.2, 60]. loopPeriodS is a whole number of them. Default
   * 8.
   */
  regularPeriodS?: number;
  /**
   * Order of Stokes' expansion of a regular wave: 1 or 2. 2 adds the second harmonic that
   * choppiness does not make. Default 1.
   */
  order?: number;
  /**
   * Wave systems, in addition to the waves of the wind and the swell: at most 8. Default: none.
   */
  systems?: WaveSystem[];
  // end of generated
}

/**
 * A sea and the outputs of its frames. Cascades are bit-identical whatever the outputs, except that
 * `foam` changes their foam and `inputs` adds waves.
 */
export interface OceanOptions extends SeaOptions {
  // generated from schema/ocean.toml: properties
  /**
   * Threads that compute, 1 to 64. Default: one per core, at most 8. It is one on a page's own
   * thread, which must not block, and in a page that is not isolated (crossOriginIsolated).
   * Results do not depend on it.
   */
  threads?: number;
  /** Enables query() and firstHit(). Default false. */
  queries?: boolean;
  /** Velocities of frames and queries; true is 'drawn'. */
  velocities?: boolean | 'none' | 'drawn' | 'water';
  /**
   * Adds pressure and velocity below the surface, which hulls need. 8 N^2 bytes for each cascade
   * of a frame, and about a quarter of its time. Waves of a pond do not decrease with depth and
   * move no water. Default false.
   */
  depth?: boolean;
  /**
   * Gradients of each cascade: normals, Jacobian and smoothness. By default a sea with cascades 1
   * has them, and an ocean whose slopes are off. Slopes and gradients cannot both be off.
   */
  gradients?: boolean;
  /**
   * Slopes and moments of each cascade, which add over cascades. By default all oceans have them
   * but those of a sea with cascades 1 that have gradients and no foam. Foam needs them.
   */
  slopes?: boolean;
  /**
   * Enables foam of breaking waves, which drifts and fades over 2.8 seconds. A frame with a tick
   * (five a second) takes about twice as long. A jump in time computes 16 ticks, which take as
   * long as ten to twenty frames. 49 N^2 bytes for each cascade. Default false.
   */
  foam?: boolean;
  /** The dynamic-wave grid; {} has the defaults. Default: no dynamic waves. */
  dynamicWaves?: DynamicWavesOptions;
  /**
   * A sea floor that refracts waves. The sea needs 2 to 4 cascades and cannot change.
   * Construction takes about a second of one core longer, and 290 bytes for each of the shore's
   * texels. By default none.
   */
  shore?: ShoreOptions;
  /** Droplets of breaking crests and emitters; {} has the defaults. Default: no spray. */
  spray?: SprayOptions;
  /**
   * Wave inputs, which are added to the waves of the wind in this order. They change the hash.
   * None may belong to another ocean. By default none.
   */
  inputs?: WaveInput[];
  // end of generated
}

/** The grid of dynamic waves: wakes, ripples and splashes. */
export interface DynamicWavesOptions {
  // generated from schema/dynamic_waves.toml: properties
  /**
   * How a tick advances the waves. "spectral": advances each wave by its own phase: the exact
   * dispersion of deep or shallow water, stable at any length of a tick; wakes have Kelvin's
   * angle. "verlet": h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt /
   * dx)^2 <= 0.4: one speed for all waves, for ponds and rings. Default "spectral".
   */
  step?: 'spectral' | 'verlet';
  /** N, texels along a side: 64, 128, 256, 512 or 1024. Default 256. */
  resolution?: number;
  /** Side of the grid, metres: [1, 10000]. Default 64. */
  sideM?: number;
  /** Ticks of the simulation a second, per second: [10, 240]. Default 60. */
  ticksPerS?: number;
  /**
   * Width of the absorbing border along each side, metres: [0.001, sideM / 4], or 0: none.
   * Default 12.
   */
  borderM?: number;
  /** Depth of the water (spectral), metres: [0.01, 11000]. Default 10000. */
  depthM?: number;
  /**
   * Eddy viscosity nu, which damps amplitudes at the rate 2 nu k^2 (spectral), square metres per
   * second: [0, 1]. Default 0.002.
   */
  viscosityM2ps?: number;
  /**
   * Speed of all waves, with (speed / (ticksPerS texel))^2 at most 0.4 (verlet), metres per
   * second: (0, 1000]. Default 3.
   */
  waveSpeedMps?: number;
  /** Decay rate of amplitudes, per second: [0, 10]. Default 0.01. */
  decayPerS?: number;
  /** Foam begins above this height and is full at twice it, metres: [0.001, 100]. Default 0.2. */
  foamHeightM?: number;
  // end of generated
}

/** A disturbance of the water: an impulse, or a source that acts in every tick. */
export interface Disturbance {
  // generated from schema/disturbance.toml: properties
  /**
   * shape. "gauss": heightM exp(-(r / radiusM)^2), cut off at 3 radii. "hull": heightM sqrt(1 -
   * (along / lengthM)^2 - (across / radiusM)^2) within that ellipse; heightM of a floating hull
   * is below 0. Default "gauss".
   */
  shape?: 'gauss' | 'hull';
  /**
   * What the shape does to the water. "pressure": a pressure, or suction, equal to the weight of
   * the shape's water: at rest the surface becomes the shape and stays so, and a moving one
   * leaves the waves of a moving pressure (Havelock 1908). The volume of the water is constant.
   * "relaxation": the surface approaches the shape: a tick removes the fraction 1 - e^(-rate
   * tick) of the difference, times the shape over its height. The bulge is bounded, and its
   * volume is added to the water. "impulse": the shape is added to the surface at once: a drop, a
   * stone. "foam": adds the foam that waves as high as the shape have, and no waves: water that a
   * hull or a propeller breaks. Default "pressure".
   */
  mode?: 'pressure' | 'relaxation' | 'impulse' | 'foam';
  /** Initial position in the world, metres: [-1e8, 1e8]. Default 0. */
  xM?: number;
  /** Initial position in the world, metres: [-1e8, 1e8]. Default 0. */
  zM?: number;
  /** Radius, of a hull half its beam, metres: [0.001, 1000]. Default 1. */
  radiusM?: number;
  /** Half the length of a hull, metres: [0.001, 1000]. Default 1. */
  lengthM?: number;
  /** Direction of a hull's length, from +x towards +z, radians: [-2 pi, 2 pi]. Default 0. */
  headingRad?: number;
  /** Height of the shape, below 0 for a floating hull, metres: [-100, 100]. Default 0. */
  heightM?: number;
  /** Rate of a relaxation, per second: (0, 1000]. Default 10. */
  ratePerS?: number;
  /** Velocity of a source until it is replaced, metres per second: [-1000, 1000]. Default 0. */
  velocityXMps?: number;
  /** Velocity of a source until it is replaced, metres per second: [-1000, 1000]. Default 0. */
  velocityZMps?: number;
  // end of generated
}

/** Spray of breaking crests and emitters. */
export interface SprayOptions {
  // generated from schema/spray_options.toml: properties
  /** Spray leaves crests within this distance of the centre, metres: [10, 200]. Default 80. */
  reachM?: number;
  /** Factor on the number of droplets of crests: [0, 10]. Default 1. */
  amount?: number;
  /** Seed of the droplets: a whole number from 0 to 4294967295. Default 1. */
  seed?: number;
  // end of generated
}

/** Droplets that leave a ball at once, for instance at the bow of a ship; in the world. */
export interface SprayEmitter {
  // generated from schema/spray_emitter.toml: properties
  /** Time at which they leave, seconds: [-1e9, 1e9]. Default 0. */
  timeS?: number;
  /** Centre of the ball, metres: [-1e8, 1e8]. Default 0. */
  xM?: number;
  /** Centre of the ball, metres: [-1e8, 1e8]. Default 0. */
  yM?: number;
  /** Centre of the ball, metres: [-1e8, 1e8]. Default 0. */
  zM?: number;
  /** Radius of the ball, metres: [0, 100]. Default 0. */
  extentM?: number;
  /** Mean velocity, metres per second: [-100, 100]. Default 0. */
  velocityXMps?: number;
  /** Mean velocity, metres per second: [-100, 100]. Default 0. */
  velocityYMps?: number;
  /** Mean velocity, metres per second: [-100, 100]. Default 0. */
  velocityZMps?: number;
  /** Largest deviation from the mean velocity, metres per second: [0, 100]. Default 0. */
  spreadMps?: number;
  /** Radius of a droplet as it leaves, metres: [0.001, 1]. Default 0.05. */
  radiusM?: number;
  /** Diameter of drops, which sets the drag, millimetres: [0.1, 5]. Default 1. */
  dropMm?: number;
  /** Number of droplets: [0, 8192]. Default 1. */
  count?: number;
  // end of generated
}

/** The droplets of a frame, in the world; positions and velocities are x, y, z of each. */
export interface Droplets {
  readonly count: number;
  readonly positionsM: Float64Array;
  readonly velocitiesMps: Float32Array;
  readonly radiusM: Float32Array;
  /** At the middle of the droplet, 0 to 1. */
  readonly opacity: Float32Array;
  /** Since it left the water, seconds. */
  readonly ageS: Float32Array;
}

/** A sea level, for instance of a tide, and a uniform current. */
export interface WaterFrame {
  // generated from schema/water_frame.toml: properties
  /** Height of still water, metres: [-1000, 1000]. Default 0. */
  seaLevelM?: number;
  /** Velocity of the water along x, metres per second: [-10, 10]. Default 0. */
  currentXMps?: number;
  /** Velocity of the water along z, metres per second: [-10, 10]. Default 0. */
  currentZMps?: number;
  // end of generated
}

/** Rain on dynamic waves. setRain() checks the ranges, which depend on the grid. */
export interface Rain {
  // generated from schema/rain.toml: properties
  /**
   * Mean number of drops, at most the value that puts 16 on a texel in a tick, per square metre
   * and second: a finite number. 0: no rain. Default 0.
   */
  dropsPerM2S?: number;
  /**
   * Radius of the crater at the rest level, metres: a finite number, [0.001, sideM / 16]. A
   * crater narrower than a texel is a texel wide on the grid, flatter and with equal volume.
   * Default 0.25.
   */
  radiusM?: number;
  /** Depth of a crater, metres: a finite number, [-10, 10]. Default 0.02. */
  heightM?: number;
  /** Seed of the drops: a whole number from 0 to 4294967295. Default 1. */
  seed?: number;
  // end of generated
}

/** A sea floor. Sample (i, j) has the position x = cornerXM + i metresPerSample, z alike. */
export interface ShoreOptions {
  /** Heights of the floor above the rest level, metres, [-11000, 9000]; element j columns + i. */
  heightsM: ArrayLike<number>;
  // generated from schema/shore.toml: properties
  /** Samples of the floor along x: 2 to 4096. */
  columns: number;
  /** Samples of the floor along z: 2 to 4096. */
  rows: number;
  /** Position of the first sample, metres: [-1e8, 1e8]. Default 0. */
  cornerXM?: number;
  /** Position of the first sample, metres: [-1e8, 1e8]. Default 0. */
  cornerZM?: number;
  /** Distance of neighbouring samples: [0.001, 10000]. Default 1. */
  metresPerSample?: number;
  /** Texels along the longer side of the shore: 64, 128, 256, 512 or 1024. Default 256. */
  resolution?: number;
  /**
   * Width of the strip along the edges over which the coarsest cascade fades into waves over the
   * floor, metres: [0, half the field's shorter side]. 0: an eighth of the shorter side. Default
   * 0.
   */
  fadeM?: number;
  /**
   * Maximum height above still water that waves reach on dry sand, with the set-up, metres:
   * [0, 10], or -1: derived. Waves in the water do not depend on it. Default -1: the height that
   * 2 % of the waves reach by Stockdon et al. 2006, from the sea's significant wave height and
   * peak period and the median slope at the waterline.
   */
  swashM?: number;
  // end of generated
}

/** A wave in deep water: amplitudeM cos(k.x - w t + phaseRad), w^2 = g k. */
export interface AnalyticWave {
  // generated from schema/analytic_wave.toml: properties
  /**
   * Amplitude; the sum of 2 pi amplitudeM / wavelengthM over the waves is at most 0.4, metres:
   * [0, 100]. Default 0.
   */
  amplitudeM?: number;
  /** wavelength, metres: [0.01, 1000]. Default 10. */
  wavelengthM?: number;
  /** Direction of travel, from +x towards +z, radians: [-2 pi, 2 pi]. Default 0. */
  directionRad?: number;
  /** Phase at x = z = t = 0, a crest by default, radians: [-2 pi, 2 pi]. Default 0. */
  phaseRad?: number;
  // end of generated
}

/** Rings around a point, which repeat with the side of the cascade that holds them. */
export interface Ripple {
  // generated from schema/ripple.toml: properties
  /** centre, metres: [-1e8, 1e8]. Default 0. */
  xM?: number;
  /** centre, metres: [-1e8, 1e8]. Default 0. */
  zM?: number;
  /** wavelength, metres: [0.01, 1000]. Default 1. */
  wavelengthM?: number;
  /**
   * Amplitude at the centre, at most wavelengthM / (2 pi), a slope of 1, metres: [0, 100].
   * Default 0.
   */
  amplitudeM?: number;
  /**
   * Radius R beyond which the rings are 0, metres: [0, 1e5]. 0 or more than half of the cascade's
   * side: half of that side. Default 0.
   */
  reachM?: number;
  /** Phase at the centre at t = 0, where 0 is a crest, radians: [-2 pi, 2 pi]. Default 0. */
  phaseRad?: number;
  // end of generated
}

/**
 * Gerstner waves. Each becomes the nearest wave of a cascade's grid with whole periods in a loop.
 * At most 64 waves; an empty list adds nothing. The choppiness is in [0, 1], where 0 is a height
 * field. Default 1.
 */
export interface GerstnerInput {
  waves: AnalyticWave[];
  choppiness?: number;
  ripple?: undefined;
}

export interface RippleInput {
  ripple: Ripple;
  waves?: undefined;
}

export type WaveInput = GerstnerInput | RippleInput;

/** Computes the spectrum of a sea. Each ocean has its own memory, which dispose() frees. */
export function createOcean(options?: OceanOptions): Promise<Ocean>;

/** Options of exact water, besides those of a sea. */
export interface ExactWaterOptions extends SeaOptions {
  /** As OceanOptions.threads. */
  threads?: number;
  // generated from schema/exact_water.toml: properties
  /** Density of the water, kilograms per cubic metre: [500, 2000]. Default 1025. */
  waterDensityKgpm3?: number;
  // end of generated
  /** Sea level and current. */
  waterFrame?: WaterFrame;
}

/** Points with heights: x, y and z of each, in metres. */
export type WaterPoints = ArrayLike<number> | [number, number, number][] | {x: number; y: number; z: number}[];

/** How the water of a frame is sampled. */
export interface WaterOptions extends QueryOptions {
  /** [500, 2000]. Default 1025. */
  waterDensityKgpm3?: number;
}

/** Water at points. In the air the pressure is 0, and the motion that of the surface. */
export interface WaterSamples {
  /** Below the surface above the point; negative in the air. */
  depthM: Float32Array;
  /** Above that of the air. */
  pressurePa: Float32Array;
  /** x, y, z of each point. */
  velocityMps: Float32Array;
  accelerationMps2: Float32Array;
}

/** The undisplaced surface: heights, and x, y, z of normals and velocities. */
export interface ExactSurface {
  heightM: Float32Array;
  normal: Float32Array;
  velocityMps: Float32Array;
}

/**
 * Water by the exact sum over the waves of a sea, by linear theory at fixed positions. Heights are
 * those of frames before displacement.
 */
export class ExactWater {
  private constructor();
  /** Moves the water to a time; 0 at first. */
  setTime(timeS: number): void;
  /** Shifts the world's origin, as Ocean.setOrigin(), for samples from now on. */
  setOrigin(xM: number, zM: number): void;
  /** Samples the water, without waves shorter than footprintM. Throws for a point below the sea floor. */
  sample(points: WaterPoints, options?: {footprintM?: number}): WaterSamples;
  /** Samples the surface. */
  sampleSurface(points: Points, options?: {footprintM?: number}): ExactSurface;
  /** Ends the threads and frees the memory. Also Symbol.dispose, if it exists. */
  dispose(): void;
}

/** Computes the waves of a sea, which is no pond. */
export function createExactWater(options?: ExactWaterOptions): Promise<ExactWater>;

/** A row of an option table. */
export interface OptionRow {
  name: string;
  default: number | string;
  /** Accepted values as text: "(0, 60]". */
  accepted: string;
  /** Range of a number. */
  least?: number;
  most?: number;
  /** Accepted words. */
  words?: string[];
}
export type SeaOption = OptionRow;
/** Returns the options of a sea. */
export function seaOptions(): Promise<SeaOption[]>;

export interface OptionTables {
  dynamicWaves: OptionRow[];
  disturbance: OptionRow[];
  rain: OptionRow[];
  shore: OptionRow[];
  spray: OptionRow[];
  sprayEmitter: OptionRow[];
  analyticWave: OptionRow[];
  ripple: OptionRow[];
  waterFrame: OptionRow[];
}
/** Returns the options of dynamic waves, disturbances, rain, shores, spray and wave inputs. */
export function optionTables(): Promise<OptionTables>;

export interface SeaPreset {
  name: string;
  summary: string;
  sea: Required<Omit<SeaOptions, 'preset'>>;
}
/** Returns the named seas, the mildest first, then beaufort-0 to beaufort-12. */
export function presets(): Promise<SeaPreset[]>;

/**
 * An ocean on the thread that made it. To compute a frame while another is drawn, call schedule(),
 * draw, then complete(). With one thread complete() does all the work. A method that fails throws
 * an Error of one line and changes nothing.
 */
export class Ocean {
  private constructor();
  /** Starts a frame and returns immediately. Accepts any finite time, in any order. */
  schedule(timeS: number): void;
  /** Returns whether complete() would return without waiting for other threads. */
  isReady(): boolean;
  /** Waits for the scheduled frame. It is valid until the second schedule() from now. */
  complete(): Frame;
  /** Schedules and completes a frame. */
  frameAt(timeS: number): Frame;

  /** Samples the frame completed last. */
  query(points: Points, options?: QueryOptions): SurfaceSamples;
  /** Samples the water. Throws without OceanOptions.depth, and for a point below the sea floor. */
  sampleWater(points: WaterPoints, options?: WaterOptions): WaterSamples;
  /** Intersects a ray with the frame completed last. */
  firstHit(ray: Ray): Hit | null;

  /**
   * Sets the sea level and the current of frames that are scheduled from now on; values left out
   * are 0. Queries and dynamic waves then use positions in the world, and the current carries the
   * water. The other data of frames do not change. Throws if the ocean has a shore.
   */
  setWaterFrame(water: WaterFrame): void;

  /**
   * Shifts the world's origin to a position of the world as it was before any shift, each in [-1e8, 1e8]. It counts
   * for frames that are scheduled from now on, for commands of dynamic waves and for spray. A position in the old
   * coordinates plus the old origin minus the new one is that in the new ones.
   */
  setOrigin(xM: number, zM: number): void;

  /**
   * Sets the centre of the spray of crests, usually the camera. It takes effect at the next
   * schedule(), for the ticks computed from then on. Throws without OceanOptions.spray, as the
   * next three methods.
   */
  setSprayCenter(xM: number, zM: number): void;
  /** Adds droplets to frames that are scheduled from now on, at most 8192 in a call. */
  emit(emitters: SprayEmitter[]): void;
  /** Returns the droplets of emitters. No frame may be in flight. */
  saveSpray(): Uint8Array;
  /** Replaces the droplets of emitters. No frame may be in flight. */
  restoreSpray(saved: Uint8Array): void;

  /**
   * Starts to compute the spectrum of another sea together with frames, which do not change yet:
   * the current sea with `options`, or a preset with the current cascades. The resolution cannot
   * change.
   */
  scheduleSea(options: SeaOptions): void;
  /** Returns whether completeSea() would return without waiting for other threads. */
  seaIsReady(): boolean;
  /** Switches to the scheduled sea from the next schedule() on. */
  completeSea(): void;
  /** Schedules and completes another sea. */
  changeSea(options: SeaOptions): void;
  /**
   * Schedules a transition to another sea: its start in the sea's time, and its duration. One from before the frame
   * scheduled last starts at that frame's time.
   */
  turnInto(options: SeaOptions, when: {fromS: number; overS: number}): void;

  /** Throws if the ocean has no dynamic waves. */
  readonly dynamicWaves: DynamicWaves;
  /**
   * Replaces the wave input of that index from the next schedule() on, by one of the same kind.
   */
  setInput(index: number, input: WaveInput): void;

  /** Every option of the sea of the latest frames. */
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly threads: number;
  /** Frames are in memory that workers share. */
  readonly isShared: boolean;
  /** Memory of this ocean in its module. */
  readonly memoryBytes: number;

  /**
   * Ends the threads and frees the memory; frames become invalid. Also Symbol.dispose, if it
   * exists.
   */
  dispose(): void;
}

/**
 * The dynamic waves of an ocean. Commands take effect at the next schedule(), in the order of the
 * calls. Equal times with equal commands between them give bit-identical waves. An earlier time
 * leaves the waves unchanged. A jump ahead computes at most half a second.
 */
export class DynamicWaves {
  private constructor();
  readonly options: Required<DynamicWavesOptions>;
  /** Acts once, in the next tick. At most 4096 impulses wait for a tick. */
  addImpulse(disturbance: Disturbance): void;
  /** Acts in every tick and moves at its velocity. Returns its number. At most 4096 sources. */
  addSource(source: Disturbance): number;
  /** Replaces a source. Does nothing if there is no source of that number. */
  setSource(number: number, source: Disturbance): void;
  /** Removes a source. Does nothing if there is no source of that number. */
  removeSource(number: number): void;
  /** Moves the grid's centre to within half a texel of the point. Texels that enter are flat. */
  setCenter(xM: number, zM: number): void;
  /** Sets the rain from the next tick on; 0 drops end it. */
  setRain(rain: Rain): void;
  /** Returns the state, without commands since the last schedule(). No frame may be in flight. */
  saveState(): Uint8Array;
  /**
   * Restores a state saved with equal options, and discards commands since the last schedule(). No
   * frame may be in flight.
   */
  restoreState(saved: Uint8Array): void;
}

/** Extremes of displacements, metres. */
export interface Bounds {
  heightMinM: number;
  heightMaxM: number;
  horizontalXMaxM: number;
  horizontalZMaxM: number;
}

/** Mean square slopes along the wind and across it. */
export interface SlopeVariance {
  upwind: number;
  crosswind: number;
}

/** Statistics of a sea, equal for all its frames. */
export interface SeaStatistics {
  significantWaveHeightM: number;
  /** Slopes in the cascades' maps, and unresolved slopes, which the roughness represents. */
  resolvedSlopes: SlopeVariance;
  unresolvedSlopes: SlopeVariance;
  roughness: number;
  /** Drift velocity of foam. */
  foamDriftXMps: number;
  foamDriftZMps: number;
  /** Compression S of half foam, see CascadeMaps.snapshots; 1000 if nothing breaks. */
  foamLevel: number;
}

/** Properties of a frame that do not refer to the module's memory. */
export interface FrameAbout {
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  /** The instruction set: "wasm128". */
  readonly isa: string;
  /** Sums of the cascades' bounds. */
  readonly bounds: Bounds;
  /** Foam that has decayed since each of the 16 snapshots; 1 and more: it has no effect. */
  readonly snapshotAges: readonly number[];
}

/**
 * A frame. The water of the undisplaced position (x, z) is drawn at (x + Dx, height, z + Dz), each
 * the sum over the cascades. Valid until the second schedule() after its own, and until dispose();
 * then it throws.
 */
export class Frame implements FrameAbout {
  private constructor();
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  readonly isa: string;
  readonly bounds: Bounds;
  readonly snapshotAges: readonly number[];
  /** At least one, the coarsest first. */
  readonly cascades: readonly Cascade[];
  /** Null without OceanOptions.dynamicWaves. */
  readonly dynamicWaves: (DynamicWavesView & {hash(): string}) | null;
  /** Null without OceanOptions.shore. */
  readonly shore: (ShoreSurface & {hash(): string}) | null;
  readonly isValid: boolean;
  /** XXH3 of the cascades, 16 hexadecimal digits; `pelagic export` writes it to sea.json. */
  hash(): string;
  /** XXH3 of the foam. */
  foamHash(): string;
  /**
   * Returns copies of the droplets: those of emitters, then those of crests, each with the newest
   * first. Droplets below the water are not removed. Throws without OceanOptions.spray.
   */
  droplets(): Droplets;
  /** XXH3 of the droplets. Throws without OceanOptions.spray. */
  sprayHash(): string;
  /** Samples the surface at any points. Throws without OceanOptions.queries. */
  query(points: Points, options?: QueryOptions): SurfaceSamples;
  /** Samples the water. Throws without OceanOptions.depth, and for a point below the sea floor. */
  sampleWater(points: WaterPoints, options?: WaterOptions): WaterSamples;
  /**
   * Returns the first intersection of a ray with the surface. Throws without OceanOptions.queries.
   */
  firstHit(ray: Ray): Hit | null;
}

/**
 * The dynamic waves of a frame, whose height adds to that of the cascades at the drawn position.
 * Arrays are views, as maps are; the other values stay valid. hash() returns the XXH3 of the
 * position and the arrays, which `pelagic export` writes to sea.json as dynamic_waves_hash.
 *
 * Texel (i, j) of the world has the position x = i texelM, z = j texelM and is element (j mod N) N
 * + i mod N. The grid has firstX <= i < firstX + N, and firstZ <= j < firstZ + N.
 */
export interface DynamicWavesView {
  /** N, texels along a side. */
  readonly resolution: number;
  readonly texelM: number;
  readonly firstX: number;
  readonly firstZ: number;
  /** N^2 elements. */
  readonly heightM: Float32Array;
  readonly verticalVelocityMps: Float32Array;
  /** 0 none to 255 full. */
  readonly foam: Uint8Array;
  /** Bounds of the height. */
  readonly heightMinM: number;
  readonly heightMaxM: number;
}

/**
 * The shore of a frame: a rectangle in which cascades are attenuated and refracted waves are added.
 * There each cascade is multiplied by its weight, and heightM is added to the sum. Arrays are
 * views, as maps are; the other values stay valid. hash() returns the XXH3 of the arrays.
 *
 * Texel (i, j) has the position x = xM + i texelM, z = zM + j texelM and is element j columns + i.
 */
export interface ShoreSurface {
  readonly columns: number;
  readonly rows: number;
  readonly texelM: number;
  /** Position of texel (0, 0). */
  readonly xM: number;
  readonly zM: number;
  /** Depth of still water, below 0 on land. */
  readonly depthM: Float32Array;
  /** Four bytes per texel: the weight of cascade t in byte t, 255 for 1. */
  readonly weightsRgba8: Uint8Array;
  readonly heightM: Float32Array;
  readonly verticalVelocityMps: Float32Array;
  /** Velocity potential of these waves at the surface. */
  readonly potentialM2ps: Float32Array;
  /** Envelope of the crests. Sand below it is wet. */
  readonly reachM: Float32Array;
  /** Foam of breaking waves, 0 none to 255 full. */
  readonly foam: Uint8Array;
  /** Bounds of the height. */
  readonly heightMinM: number;
  readonly heightMaxM: number;
  /** Largest change of a weight per metre. */
  readonly weightsChangePerM: number;
}

/** Properties of a cascade that do not refer to the module's memory. */
export interface CascadeAbout {
  /** L: the cascade repeats after this length along both of its own axes. */
  readonly sideM: number;
  /** N, texels along a side. */
  readonly resolution: number;
  /** L / N. */
  readonly texelM: number;
  /**
   * Rotation of the grid against the world, from +x towards +z. With its cosine c and sine s, texel
   * (i, j) has the undisplaced position x = (c i - s j) L/N, z = (s i + c j) L/N. Vectors in maps
   * are along the world's axes.
   */
  readonly rotationRad: number;
  readonly cosine: number;
  readonly sine: number;
  readonly bounds: Bounds;
  /** Units of the bytes of `slopes` and `moments`. */
  readonly slopeRange: number;
  readonly varianceRange: number;
  /** Variance of the slope over the cascade. */
  readonly slopeVariance: number;
  /** Whether the cascade's waves make foam in the sum. */
  readonly makesWhitecaps: boolean;
  /** q over -(D_xx + D_zz + front . (h_x, h_z)) of this cascade, see CascadeMaps.snapshots. */
  readonly compressionScale: number;
  /** The front, which all cascades share. */
  readonly compressionFrontX: number;
  readonly compressionFrontZ: number;
  /** Texel (i, j) has the snapshots of texel (i - driftColumns, j - driftRows). */
  readonly driftColumns: number;
  readonly driftRows: number;
  /** Four numbers, each of which differs whenever its image of snapshots differs. */
  readonly snapshotsVersion: readonly number[];
}

/**
 * The maps of a cascade, in rows of texels along its first axis. They are views of the module's
 * memory. After the frame's validity they hold those of another frame. The memory grows for a
 * larger batch of points than before, or for another sea. Unless isShared, growth empties the
 * views. So read `cascade.displacement` again for each use, and copy what you keep.
 */
export interface CascadeMaps {
  /** N^2 texels of four half floats, RGBA16F: Dx, height, Dz in metres, 0. */
  readonly displacement: Uint16Array;
  /**
   * levelCount(N) mip levels, RGBA8: normal x, normal z, Jacobian, smoothness, of this cascade
   * alone. Null without OceanOptions.gradients.
   */
  readonly gradients: Uint8Array | null;
  /**
   * Mip levels, RGBA8, which add to those of other cascades: in `slopes` h_x, h_z, D_xx, D_zz; in
   * `moments` D_xz, the variances of h_x and h_z within the texel, their covariance. A byte b is
   * b/255 varianceRange for a variance, (b - 128)/127 varianceRange for the covariance, else
   * (b - 128)/127 slopeRange. The normal of the sums is
   * (h_z D_xz - h_x (1 + D_zz), J, h_x D_xz - h_z (1 + D_xx)), J = (1 + D_xx)(1 + D_zz) - D_xz^2.
   * Null without OceanOptions.slopes.
   */
  readonly slopes: Uint8Array | null;
  readonly moments: Uint8Array | null;
  /**
   * N^2 bytes: a byte b is the compression q = -3 + 8 b/255 now. Null without OceanOptions.foam, and
   * for a cascade that makes no foam.
   */
  readonly compression: Uint8Array | null;
  /**
   * Four chains of mip levels, RGBA8: q at 16 past ticks, snapshot s in byte s % 4 of image
   * floor(s / 4). With S the sum of q over the cascades, the foam at a position is the largest of
   * clamp(1/2 + (S - SeaStatistics.foamLevel) / 0.3, 0, 1) of `compression`, and that minus
   * snapshotAges[s] of snapshot s. Null as `compression`.
   */
  readonly snapshots: readonly Uint8Array[] | null;
  /** Metres, in single precision. */
  readonly dx: Plane;
  readonly height: Plane;
  readonly dz: Plane;
  /** Metres per second. Null unless OceanOptions.velocities is true or 'drawn'. */
  readonly velocityX: Plane | null;
  readonly velocityY: Plane | null;
  readonly velocityZ: Plane | null;
}

export interface Cascade extends CascadeAbout, CascadeMaps {}

/**
 * A square of floats, stored in blocks of a few columns as the kernels compute them; a view as maps
 * are. Texel (i, j) is element floor(i / blockColumns) blockStride + j rowStride + i %
 * blockColumns.
 */
export class Plane {
  private constructor();
  readonly data: Float32Array;
  readonly resolution: number;
  readonly blockColumns: number;
  readonly rowStride: number;
  readonly blockStride: number;
  at(i: number, j: number): number;
  /** Returns a copy in rows, with texel (i, j) at j N + i. */
  toRows(out?: Float32Array): Float32Array;
}

/** Returns the number of mip levels: N, N / 2, ..., 1 texels along a side. */
export function levelCount(resolution: number): number;
/** Returns the first texel of a mip level. */
export function levelOffset(resolution: number, level: number): number;

/** Positions in the world, metres: x, z, x, z, ... or pairs. */
export type Points = ArrayLike<number> | readonly (readonly [number, number])[] | readonly {x: number; z: number}[];

export interface QueryOptions {
  /** Largest error of a converged point, metres. Default 0.001. */
  toleranceM?: number;
  /**
   * "linear" is the drawn surface. "cubic", for measurements, keeps the heights and slopes of short
   * waves and takes 2 to 4 times as long. Foam is linear in both. Default "linear".
   */
  interpolation?: 'linear' | 'cubic';
  /**
   * Leaves out waves shorter than about this length, metres; needs OceanOptions.depth. Velocities are
   * then the water's own. Default 0.
   */
  footprintM?: number;
}

/** One element, or three, for each point; copies. */
export interface SurfaceSamples {
  heightM: Float32Array;
  /** x, y, z of the unit normal of the displaced surface. */
  normal: Float32Array;
  /** 1 for still water, small at sharp crests, negative where the surface is overturned. */
  jacobian: Float32Array;
  /** Horizontal distance from the point to the sample's drawn position. */
  errorM: Float32Array;
  /** 1 if the error is within the tolerance. */
  converged: Uint8Array;
  /** x, y, z of the water's velocity. With OceanOptions.velocities. */
  velocityMps?: Float32Array;
  /** Foam, 0 to 1. With OceanOptions.foam. */
  foam?: Float32Array;
}

export interface Ray {
  originM: readonly [number, number, number];
  /** Of any length but 0. */
  direction: readonly [number, number, number];
  /** Length of the search: 0 to a million texels of the coarsest cascade. */
  reachM: number;
}

export interface Hit {
  distanceM: number;
  positionM: [number, number, number];
  normal: [number, number, number];
  /** The ray leaves the water. */
  fromBelow: boolean;
}
