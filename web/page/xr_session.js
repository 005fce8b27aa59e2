// A headset's session, which draws the sea for two eyes at the predicted display time.
//
//   if (await XrSession.isSupported())
//     button.onclick = async () => {
//       const session = await XrSession.enter(view, {timeS: 12});
//       await session.ended;
//     };
//
// Each frame calls simulate(), then draw() with both eyes and the headset's layer, for which
// patches are selected once. The page must not draw during a session, because both use one view.

/** Height of the eyes above the floor, if the headset does not know its floor. */
const eyeHeightM = 1.6;
/** The far plane of other objects; the sea is drawn without one. */
const depthFarM = 10000;

export class XrSession {
  /** Returns whether there is a headset. @param xr  navigator.xr or a substitute */
  static async isSupported(xr = globalThis.navigator?.xr) {
    return Boolean(await xr?.isSessionSupported('immersive-vr').catch(() => false));
  }

  /**
   * Starts a session. Browsers require a click. Rejects with the browser's error if the user or the
   * browser declines.
   *
   * @param view       a SeaView; its sea and light do not change
   * @param timeS      the sea's time of the first frame
   * @param origin     position of the room's floor, metres: [x, height above the rest level, z]
   * @param drawMore   (framebuffer, eyes, origin) => void, called after the sea of each frame
   * @param scale      of the image's resolution; 1 is the headset's recommendation
   * @param foveation  reduction of the resolution at the edges, 0 to 1, if the headset supports it
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
    /** The error of a frame, which ends the session. */
    this.error = undefined;
    /** Resolves at the end of the session; rejects with a frame's error. */
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
      if (pose) this.draw(pose);  // none while the headset has lost tracking
    } catch (error) {
      this.error = error;
      this.session.end().catch(() => {});
    }
  }

  /** Advances the sea's time with the display's, except while the session is hidden. */
  advance(seenMs) {
    if (this.lastSeenMs !== undefined) this.timeS += (seenMs - this.lastSeenMs) / 1000;
    this.lastSeenMs = seenMs;
    this.view.simulate(this.timeS);
  }

  draw(pose) {
    const {framebuffer, framebufferWidth: width, framebufferHeight: height} = this.layer;
    // Some headsets have further views, for observers; the second view of a mono one is empty.
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

/** Returns the best supported reference space, and the height of its origin above the floor. */
async function referenceSpaceOf(session) {
  for (const [type, floorM] of [['local-floor', 0], ['local', eyeHeightM], ['viewer', eyeHeightM]]) {
    try {
      return {space: await session.requestReferenceSpace(type), floorM};
    } catch {
      // Not supported.
    }
  }
  throw new Error('the headset has no reference space to stand in: neither local-floor nor local nor viewer');
}
