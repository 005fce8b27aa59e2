// A headset's session: the sea for two eyes, at the time at which a frame will be seen.
//
//   if (await XrSession.isSupported())
//     button.onclick = async () => { const session = await XrSession.enter(view, {timeS: 12}); await session.ended; };
//
// Each frame: simulate() at the predicted display time, then one draw() of both eyes into the headset's layer, of which the renderer
// selects patches once. The page's own frames should rest meanwhile: there is one view and one sea.

/** Metres from a floor to the eyes of somebody standing, where the headset does not know its floor. */
const eyeHeightM = 1.6;
/** The sea has no far plane, whatever a projection says; this one is for what else a page draws. */
const depthFarM = 10000;

export class XrSession {
  /** Whether there is a headset. \param xr  navigator.xr, or what stands for it */
  static async isSupported(xr = globalThis.navigator?.xr) {
    return Boolean(await xr?.isSessionSupported('immersive-vr').catch(() => false));
  }

  /**
   * Asks the user for the headset, so call it from a click. Rejects with the browser's own error if he or it declines.
   *
   * @param view       a SeaView, whose sky and sea stay as they are
   * @param timeS      the sea's time at the first frame
   * @param origin     where the floor of the room stands, metres: [x, height above the sea, z]
   * @param drawMore   (framebuffer, eyes) => void after the sea of each frame, for what else is to be seen
   * @param scale      of the image's resolution, 1 is the headset's own advice
   * @param foveation  how much coarser an image may be at its edges, 0 to 1, where the headset offers that
   */
  static async enter(view, {xr = navigator.xr, timeS = 0, origin = [0, 3, 0], drawMore, scale = 1, foveation = 0.5} = {}) {
    const session = await xr.requestSession('immersive-vr', {optionalFeatures: ['local-floor']});
    try {
      const gl = view.context;
      await gl.makeXRCompatible();
      const layer = new XRWebGLLayer(session, gl, {alpha: false, antialias: true, depth: true, stencil: false, framebufferScaleFactor: scale});
      if (typeof layer.fixedFoveation === 'number') layer.fixedFoveation = foveation;
      await session.updateRenderState({baseLayer: layer, depthNear: 0.1, depthFar: depthFarM});
      const {space, floorM} = await referenceSpaceOf(session);
      return new XrSession(session, {view, layer, space, timeS, drawMore, origin: [origin[0], origin[1] + floorM, origin[2]]});
    } catch (error) {
      await session.end().catch(() => {});
      throw error;
    }
  }

  constructor(session, parts) {
    Object.assign(this, parts);
    this.session = session;
    this.frames = 0;
    /** The first error of a frame, which ends the session. */
    this.error = undefined;
    /** Resolves when the session is over, whoever ended it; rejects with a frame's error. */
    this.ended = new Promise((resolve, reject) => {
      session.addEventListener('end', () => (this.error ? reject(this.error) : resolve()));
    });
    session.addEventListener('visibilitychange', () => {
      if (session.visibilityState === 'hidden') this.lastSeenMs = undefined;
    });
    session.requestAnimationFrame((now, frame) => this.frame(now, frame));
  }

  end() {
    return this.session.end();
  }

  frame(now, frame) {
    this.session.requestAnimationFrame((later, next) => this.frame(later, next));
    try {
      this.advance(frame.predictedDisplayTime ?? now);
      const pose = frame.getViewerPose(this.space);
      if (pose) this.draw(pose);  // the headset may have lost its place
    } catch (error) {
      this.error = error;
      this.session.end().catch(() => {});
    }
  }

  /** The sea's time runs with the display's, and stands still while nobody sees it. */
  advance(seenMs) {
    if (this.lastSeenMs !== undefined) this.timeS += (seenMs - this.lastSeenMs) / 1000;
    this.lastSeenMs = seenMs;
    this.view.simulate(this.timeS);
  }

  draw(pose) {
    const {framebuffer, framebufferWidth: width, framebufferHeight: height} = this.layer;
    // Some headsets have more views than eyes, for observers; a mono one has an empty second view.
    const eyes = pose.views
      .map(view => ({viewport: this.layer.getViewport(view), view}))
      .filter(({viewport}) => viewport && viewport.width > 0 && viewport.height > 0)
      .slice(0, 2)
      .map(({viewport: {x, y, width, height}, view}) =>
        ({viewport: [x, y, width, height], view: view.transform.inverse.matrix, projection: view.projectionMatrix}));
    if (eyes.length === 0) return;
    this.view.draw({framebuffer, width, height, eyes, origin: this.origin});
    this.drawMore?.(framebuffer, eyes, this.origin);
    ++this.frames;
  }
}

/** The room with its floor, or what comes next to it. */
async function referenceSpaceOf(session) {
  for (const [type, floorM] of [['local-floor', 0], ['local', eyeHeightM], ['viewer', eyeHeightM]]) {
    try {
      return {space: await session.requestReferenceSpace(type), floorM};
    } catch {
      // The next one.
    }
  }
  throw new Error('the headset has no reference space to stand in: neither local-floor nor local nor viewer');
}
