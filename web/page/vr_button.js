// The button that leads into a headset, shown where the browser says that there is one.

/** \param page  main.js's: its view, gl, advance() and draw() */
export async function offerVr(button, page) {
  if (!await navigator.xr?.isSessionSupported('immersive-vr').catch(() => false)) return;
  const {XrSession} = await import('./xr_session.js');
  button.hidden = false;
}
