// The sea in a worker: the same as index.d.ts, as promises.
import type {
  Answers, Bounds, FrameAbout, Hit, OceanOptions, Points, QueryOptions, Ray, SeaStatistics, SeaOptions, CascadeAbout, CascadeMaps,
} from './index.js';

export { seaOptions, presets, levelCount, levelOffset, Plane } from './index.js';

export interface RemoteOceanOptions extends OceanOptions {
  /** What comes with a frame; all else of a cascade is null then. Default: displacement, gradients, slopes, moments and foam, as far as frames have them. */
  maps?: (keyof CascadeMaps)[];
}

/** Bakes the sea in a worker, which has threads of its own where the page is isolated, and in node. */
export function createOcean(options?: RemoteOceanOptions): Promise<RemoteOcean>;

export class RemoteOcean {
  private constructor();
  readonly threads: number;
  /** Maps are the worker's memory itself, without a copy; else each frame brings its own, copied once in the worker. */
  readonly isShared: boolean;

  /** The worker computes the frame and doesn't wait for complete(). */
  schedule(timeS: number): void;
  complete(): Promise<RemoteFrame>;
  frameAt(timeS: number): Promise<RemoteFrame>;
  query(points: Points, options?: QueryOptions): Promise<Answers>;
  firstHit(ray: Ray): Promise<Hit | null>;
  changeSea(options: SeaOptions): Promise<void>;
  turnInto(options: SeaOptions, when: {fromS: number; overS: number}): Promise<void>;
  sea(): Promise<Required<Omit<SeaOptions, 'preset'>>>;
  memoryBytes(): Promise<number>;
  /** Ends the worker; promises that it still owes are rejected. */
  dispose(): void;
}

/** Where memory is shared, valid as a Frame is: until the second schedule() after its own. Where it isn't, its maps are yours. */
export class RemoteFrame implements FrameAbout {
  private constructor();
  readonly timeS: number;
  readonly sea: Required<Omit<SeaOptions, 'preset'>>;
  readonly statistics: SeaStatistics;
  readonly isa: string;
  readonly bounds: Bounds;
  readonly cascades: readonly RemoteCascade[];
  hash(): Promise<string>;
  foamHash(): Promise<string>;
  query(points: Points, options?: QueryOptions): Promise<Answers>;
  firstHit(ray: Ray): Promise<Hit | null>;
}

export type RemoteCascade = CascadeAbout & {readonly [Name in keyof CascadeMaps]: CascadeMaps[Name] | null};
