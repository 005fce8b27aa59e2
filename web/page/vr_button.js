// The button that starts a headset's session, shown if the browser has a headset.

import {XrSession} from './xr_session.js';

/**
 * @param start  () => {view, ...options of XrSession.enter()}; called on a click
 * @param rest   (isInVr) => void; the page draws no frames while isInVr
 * @param fail   (line) => void
 */
export async function offerVr(button, start, rest, fail) {
  if (!await XrSession.isSupported()) return;
  button.hidden = false;
  button.addEventListener('click', async () => {
    const {view, ...options} = start();
    rest(true);
    try {
      const session = await XrSession.enter(view, options);
      await session.ended;
    } catch (error) {
      fail(`The headset can't be entered: ${error.message}`);
    } finally {
      rest(false);
    }
  });
}
