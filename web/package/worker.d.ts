// Oceans in a worker: the interface of index.d.ts, with promises.
import type {
  Bounds, CascadeAbout, CascadeMaps, Disturbance, Droplets, DynamicWavesOptions, DynamicWavesView, FrameAbout, Hit, OceanOptions, Points,
  QueryOptions, Rain, Ray, SeaOptions, SeaStatistics, ShoreSurface, SprayEmitter, SurfaceSamples, WaterFrame,
  WaterOptions, WaterPoints, WaterSamples, WaveInput,
} from './index.js';

export { seaOptions, optionTables, presets, levelCount, levelOffset, Plane } from './index.js';

export interface RemoteOceanOptions extends OceanOptions {
  /**
   * The maps of each frame; the others are null. Default: displacement, gradients, slopes and
   * moments, if frames have them.
   */
  maps?: (keyof CascadeMaps)[];
}

/**
 * Computes the spectrum of a sea in a worker. It may have threads in an isolated page and in node.
 */
export function createOcean(options?: RemoteOceanOptions): Promise<RemoteOcean>;

export class RemoteOcean {
  private constructor();
  readonly threads: number;
  /** Maps are the worker's memory. If false, each frame has copies, made in the worker. */
  readonly isShared: boolean;
  /** Its methods reject if the ocean has no dynamic waves. */
  readonly dynamicWaves: RemoteDynamicWaves;

  /** Starts a frame. The worker computes it without waiting for complete(). */
  schedule(timeS: number): void;
  complete(): Promise<RemoteFrame>;
  frameAt(timeS: number): Promise<RemoteFrame>;
  query(points: Points, options?: QueryOptions): Promise<SurfaceSamples>;
  sampleWater(points: WaterPoints, options?: WaterOptions): Promise<WaterSamples>;
  firstHit(ray: Ray): Promise<Hit | null>;
  setWaterFrame(water: WaterFrame): Promise<void>;
  setOrigin(xM: number, zM: number): Promise<void>;
  setSprayCenter(xM: number, zM: number): Promise<void>;
  emit(emitters: SprayEmitter[]): Promise<void>;
  saveSpray(): Promise<Uint8Array>;
  restoreSpray(saved: Uint8Array): Promise<void>;
  changeSea(options: SeaOptions): Promise<void>;
  turnInto(options: SeaOptions, when: {fromS: number; overS: number}): Promise<void>;
  setInput(index: number, input: WaveInput): Promise<void>;
  sea(): Promise<Required<Omit<SeaOptions, 'preset'>>>;
  memoryBytes(): Promise<number>;
  /** Ends the worker. Pending promises are rejected. */
  dispose(): void;
}

/** Dynamic waves. The worker executes commands and frames in the order of the calls. */
export class RemoteDynamicWaves {
  private constructor();
  options(): Promise<Required<DynamicWavesOptions>>;
  addImpulse(disturbance: Disturbance): Promise<void>;
  addSource(source: Disturbance): Promise<number>;
  setSource(number: number, source: Disturbance): Promise<void>;
  removeSource(number: number): Promise<void>;
  setCenter(xM: number, zM: number): Promise<void>;
  setRain(rain: Rain): Promise<void>;
  saveState(): Promise<Uint8Array>;
  restoreState(saved: Uint8Array): Promise<void>;
}

/**
 * With shared memory, valid until the second schedule() after its own; else its maps are copies.
 */
export class RemoteFrame implements FrameAbout {
  private constructor();
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  readonly isa: string;
  readonly bounds: Bounds;
  readonly snapshotAges: readonly number[];
  readonly cascades: readonly RemoteCascade[];
  readonly dynamicWaves: (DynamicWavesView & {hash(): Promise<string>}) | null;
  readonly shore: (ShoreSurface & {hash(): Promise<string>}) | null;
  hash(): Promise<string>;
  foamHash(): Promise<string>;
  droplets(): Promise<Droplets>;
  sprayHash(): Promise<string>;
  query(points: Points, options?: QueryOptions): Promise<SurfaceSamples>;
  sampleWater(points: WaterPoints, options?: WaterOptions): Promise<WaterSamples>;
  firstHit(ray: Ray): Promise<Hit | null>;
}

export type RemoteCascade = CascadeAbout & {readonly [Name in keyof CascadeMaps]: CascadeMaps[Name] | null};
