package arcstart;

import java.awt.Dimension;
import java.awt.Graphics;
import java.awt.event.ActionEvent;
import java.awt.image.BufferedImage;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import javax.imageio.ImageIO;
import javax.swing.AbstractAction;
import javax.swing.Action;
import javax.swing.JDesktopPane;
import javax.swing.JFrame;
import javax.swing.JPanel;
import javax.swing.Timer;
import lcm.spy.ChannelData;
import lcm.spy.SpyPlugin;

/** Shows image_t in lcm-spy as a picture: right-click a channel, "Show image". Meant for previews. */
public class ImagePlugin implements SpyPlugin {
  @Override
  public boolean canHandle(long fingerprint) {
    return fingerprint == image_t.LCM_FINGERPRINT;
  }

  @Override
  public Action getAction(JDesktopPane desktop, ChannelData channel) {
    return new AbstractAction("Show image") {
      @Override
      public void actionPerformed(ActionEvent event) {
        show(channel);
      }
    };
  }

  private static void show(ChannelData channel) {
    JPanel panel =
        new JPanel() {
          @Override
          protected void paintComponent(Graphics graphics) {
            super.paintComponent(graphics);
            BufferedImage picture = decode((image_t) channel.last);
            if (picture == null) return;
            double scale =
                Math.min((double) getWidth() / picture.getWidth(), (double) getHeight() / picture.getHeight());
            graphics.drawImage(
                picture, 0, 0, (int) (scale * picture.getWidth()), (int) (scale * picture.getHeight()), null);
          }
        };
    panel.setPreferredSize(new Dimension(800, 600));
    JFrame frame = new JFrame(channel.name);
    frame.add(panel);
    frame.pack();
    frame.setVisible(true);
    Timer timer = new Timer(250, event -> panel.repaint());
    timer.start();
    frame.setDefaultCloseOperation(JFrame.DISPOSE_ON_CLOSE);
    frame.addWindowListener(
        new java.awt.event.WindowAdapter() {
          @Override
          public void windowClosed(java.awt.event.WindowEvent event) {
            timer.stop();
          }
        });
  }

  /** The picture, or null where the message carries none. */
  static BufferedImage decode(image_t message) {
    if (message == null || message.size == 0) return null;
    if (message.encoding == image_t.PNG) {
      try {
        return ImageIO.read(new ByteArrayInputStream(message.data));
      } catch (IOException error) {
        return null;
      }
    }
    if (message.encoding != image_t.MONO8 || message.size != message.width * message.height) return null;
    BufferedImage picture = new BufferedImage(message.width, message.height, BufferedImage.TYPE_BYTE_GRAY);
    picture.getRaster().setDataElements(0, 0, message.width, message.height, message.data);
    return picture;
  }
}
